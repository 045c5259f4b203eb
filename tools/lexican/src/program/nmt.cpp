// SPDX-License-Identifier: Apache-2.0
// lexican nmt: sends an NMT command, and waits until the device has the state.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "program/bus_host.hpp"
#include "program/verb.hpp"

namespace lexican::program {
namespace {

struct Command {
  const char* name;
  CO_NMT_COMMAND specifier;
  std::uint8_t state;  ///< that error control shows afterwards; a reset ends with a boot-up message, 0
};

constexpr Command commands[] = {
    {"start", CO_NMT_COMMAND_START, 0x05},          {"stop", CO_NMT_COMMAND_STOP, 0x04},
    {"preop", CO_NMT_COMMAND_PREOP, 0x7F},          {"reset", CO_NMT_COMMAND_RESET_NODE, 0x00},
    {"reset-comm", CO_NMT_COMMAND_RESET_COM, 0x00},
};

struct Options {
  Common common;
  std::string command;
  std::string node;
};

/// Asks on the terminal.
/// \retval true  the answer is yes
bool is_confirmed(const std::string& question) {
  fmt::print(stderr, "{} [y/N] ", question);
  char answer[16] = "";
  return std::fgets(answer, sizeof answer, stdin) != nullptr && (answer[0] == 'y' || answer[0] == 'Y');
}

std::string state_text(std::uint8_t state) {
  switch (state) {
    case 0x00: return "boot-up";
    case 0x04: return "stopped";
    case 0x05: return "operational";
    case 0x7F: return "pre-operational";
    default: return fmt::format("unknown state {:02X}h", state);
  }
}

/// Sends the command as soon as the bus accepts it.
/// \retval false  the bus has accepted nothing for \a timeout
bool send(host_bus::Bus& bus, BusHost& host, const CO_IF_FRM& frame, Micros timeout) {
  const Micros begin = host.now();
  while (!bus.send(frame)) {
    if (host.interrupted() || host.now() - begin >= timeout) {
      return false;
    }
    host.wait(millisecond);
    bus.receive();
  }
  return true;
}

/// Waits until an adapter has the whole command.
void flush(host_bus::Bus& bus, BusHost& host) {
  const Micros begin = host.now();
  while ((bus.wanted().events & POLLOUT) != 0 && host.now() - begin < 100 * millisecond) {
    host.wait(millisecond);
    bus.receive();
  }
}

/// Waits until the error control of the device shows the state.
int wait_for_state(host_bus::Bus& bus, BusHost& host, std::uint8_t node, const Command& command, Micros timeout,
                   bool is_json) {
  const Micros begin = host.now();
  std::uint8_t last = 0xFF;
  while (host.now() - begin < timeout && !host.interrupted()) {
    while (const std::optional<host_bus::Entry> entry = bus.receive()) {
      if (entry->frame.Identifier != 0x700U + node || entry->frame.DLC != 1) {
        continue;
      }
      last = entry->frame.Data[0] & 0x7FU;
      if (last == command.state) {
        if (!is_json) {
          print(fmt::format("node {} {}\n", node, last == 0 ? "has booted" : "is " + state_text(last)));
        }
        return ok;
      }
    }
    host.wait(10 * millisecond);
  }
  if (Interruption::happened()) {
    print_message("interrupted; the command was sent");
    return interrupted;
  }
  if (!bus.fault().empty()) {
    print_message(bus.fault());
    return bus_fault;
  }
  if (last == 0xFF) {
    print_message(
        fmt::format("sent; node {} sends no heartbeat, so its state is unknown (1017h switches it on)", node));
    return command.state == 0 ? no_answer : ok;
  }
  print_message(fmt::format("node {} is {}, not {}", node, state_text(last), state_text(command.state)));
  return refused;
}

int run(const Options& options) {
  const bool is_all = options.node == "all";
  const std::uint8_t node = is_all ? std::uint8_t{0} : node_of(options.node);
  if (!is_all && node == 0) {
    print_message("'" + options.node + "' is no node-ID, which is 1 to 127, or all");
    return usage;
  }
  const Command* chosen = nullptr;
  for (const Command& command : commands) {
    chosen = options.command == command.name ? &command : chosen;
  }
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  const bool is_grave = is_all || chosen->state == 0;
  if (is_grave && bus->is_physical() && !options.common.is_sure) {
    if (isatty(STDIN_FILENO) == 0) {
      print_message("this command changes a physical bus: confirm it by --yes");
      return usage;
    }
    if (!is_confirmed(fmt::format("{} {} on a physical bus?", chosen->name, options.node))) {
      return usage;
    }
  }
  const Interruption interruption;
  BusHost host(*bus, interruption);
  const Micros timeout = options.common.timeout * millisecond;
  const CO_IF_FRM frame = {0, {static_cast<std::uint8_t>(chosen->specifier), node}, 2};
  if (!send(*bus, host, frame, timeout)) {
    print_message("the command was not sent: " + (bus->fault().empty() ? "the bus accepts no frames" : bus->fault()));
    return Interruption::happened() ? interrupted : bus_fault;
  }
  if (is_all) {
    flush(*bus, host);
  }
  status = is_all ? ok : wait_for_state(*bus, host, node, *chosen, timeout, options.common.is_json);
  if (status == ok && is_all && !options.common.is_json) {
    print(fmt::format("{} was sent to all nodes\n", chosen->name));
  }
  if (options.common.is_json) {
    const nlohmann::json json = {{"command", chosen->name}, {"node", options.node}, {"done", status == ok}};
    print(json.dump() + '\n');
  }
  return status;
}

}  // namespace

Verb add_nmt(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  Arguments arguments = line.add_command("nmt", "Change the NMT state of a device, or of all");
  std::vector<std::string> words;
  for (const Command& command : commands) {
    words.emplace_back(command.name);
  }
  arguments.add_option("command", options->command, "start, stop, preop, reset or reset-comm").required().one_of(words);
  arguments.add_option("node", options->node, "Node-ID, 1 to 127, or all").required();
  add_bus_options(arguments, options->common);
  add_timeout_option(arguments, options->common, 2000);
  arguments.end_help(
      "Examples:\n"
      "  lexican nmt start 5 -i can0\n"
      "  lexican nmt reset all --yes -i can0");
  return {arguments, [options] { return run(*options); }};
}

}  // namespace lexican::program
