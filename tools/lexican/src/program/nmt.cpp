// SPDX-License-Identifier: Apache-2.0
// lexican nmt: sends an NMT command, and waits until the device has the state.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "program/actions.hpp"

namespace lexican::program {
namespace {

constexpr std::uint8_t boot_up_state = 0x00;
constexpr std::uint8_t stopped_state = 0x04;

constexpr StateCommand commands[] = {
    {"start", CO_NMT_COMMAND_START, 0x05},
    {"stop", CO_NMT_COMMAND_STOP, stopped_state},
    {"preop", CO_NMT_COMMAND_PREOP, 0x7F},
    {"reset", CO_NMT_COMMAND_RESET_NODE, boot_up_state},
    {"reset-comm", CO_NMT_COMMAND_RESET_COM, boot_up_state},
};

/// Waits until an adapter has the whole command, and for its answer.
void flush(host_bus::Bus& bus, BusHost& host) {
  const Micros begin = host.now();
  while (((bus.wanted().events & POLLOUT) != 0 || host.now() - begin < 50 * millisecond) &&
         host.now() - begin < 100 * millisecond) {
    host.wait(millisecond);
    bus.receive();
  }
}

/// Heartbeat time of a device, read from 1017h.
struct HeartbeatTime {
  bool is_answered = false;           ///< the device has answered the request, or was heard meanwhile, or was not asked
  std::optional<std::uint32_t> time;  ///< ms; 0: off
};

HeartbeatTime read_heartbeat_time(Session& session, std::uint32_t timeout) {
  const Transfer transfer = session.sdo().upload(0x1017, 0, {SdoClient::small, timeout, {}});
  const bool is_number = transfer.done() && transfer.data.size() == 2;
  return {!transfer.is_unanswered() || session.state().has_value(),
          is_number ? std::optional(static_cast<std::uint32_t>(number_of(transfer.data))) : std::nullopt};
}

/// Prints why the state of a device is unknown.
int report_unknown(std::uint8_t node, const StateCommand& command, std::uint32_t timeout,
                   const HeartbeatTime& heartbeat) {
  const std::string sent = fmt::format("sent; node {} has sent no ", node);
  if (command.state == 0) {
    print_message(sent + fmt::format("boot-up message within {} ms", timeout));
    return no_answer;
  }
  if (!heartbeat.is_answered && command.state == stopped_state) {
    print_message(sent + "heartbeat, and did not answer before: it is not there, or was stopped already");
    return no_answer;
  }
  if (!heartbeat.is_answered) {
    print_message(sent + "heartbeat, and does not answer; lexican scan shows who answers");
    return no_answer;
  }
  print_message(sent + "heartbeat, so its state is unknown" +
                (!heartbeat.time.has_value()                              ? ""
                 : *heartbeat.time == 0 && command.state == stopped_state ? ""
                 : *heartbeat.time == 0 ? fmt::format("; lexican write {} 1017 1000 switches it on", node)
                                        : fmt::format(", although 1017h is {} ms", *heartbeat.time)));
  return ok;
}

/// Waits for the state, and prints whether the device has it. A heartbeat may be slower than --timeout.
/// \a before: what was read before the command; nothing: it is read if there is no heartbeat.
int report_state(Session& session, std::uint8_t node, const StateCommand& command, const Common& common,
                 const std::optional<HeartbeatTime>& before) {
  const bool has_heartbeat = command.state != boot_up_state;
  // A boot-up message is no heartbeat: a device that has booted meanwhile may send none.
  const auto wait = [&](Micros time) {
    const std::uint8_t state = wait_for_state(session, node, command.state, time);
    return has_heartbeat && state == boot_up_state ? no_state : state;
  };
  std::uint8_t last = wait(common.timeout * millisecond);
  HeartbeatTime heartbeat{true, std::nullopt};
  if (last == no_state && has_heartbeat && !session.host().interrupted()) {
    heartbeat = before ? *before : read_heartbeat_time(session, common.timeout);
    const std::uint32_t time = heartbeat.time.value_or(0);
    if (time != 0) {
      print_note(fmt::format("waiting for the heartbeat of node {}, which it sends every {} ms", node, time));
      last = wait((time + time / 2) * millisecond);
    }
  }
  if (session.is_interrupted()) {
    print_message("interrupted; the command was sent");
    return interrupted;
  }
  if (!session.bus().fault().empty()) {
    print_message(session.bus().fault());
    return bus_fault;
  }
  if (last == no_state) {
    return report_unknown(node, command, common.timeout, heartbeat);
  }
  if (last != command.state) {
    print_message(fmt::format("node {} is {}, not {}", node, state_text(last), state_text(command.state)));
    return refused;
  }
  if (!common.is_json) {
    print(fmt::format("node {} {}\n", node, last == 0 ? "has booted" : "is " + state_text(last)));
  }
  return ok;
}

}  // namespace

std::optional<StateCommand> state_command(const NmtOptions& options) {
  if (!options.node) {
    print_message("which node? Give its node-ID, 1 to 127, or all");
    return std::nullopt;
  }
  const bool is_all = options.node == "all";
  const std::uint8_t node = is_all ? std::uint8_t{0} : node_of(*options.node);
  if (!is_all && node == 0) {
    print_message("'" + *options.node + "' is no node-ID, which is 1 to 127, or all");
    return std::nullopt;
  }
  for (const StateCommand& command : commands) {
    if (options.command == command.name) {
      StateCommand found = command;
      found.node = node;
      return found;
    }
  }
  print_message("'" + options.command + "' is no command; commands are start, stop, preop, reset and reset-comm");
  return std::nullopt;
}

int agree(const host_bus::Bus& bus, const NmtOptions& options, const StateCommand& command) {
  return command.is_grave() ? agree(bus, options.common, fmt::format("{} {}", command.name, *options.node)) : int{ok};
}

int change_state(Session& session, const NmtOptions& options, const StateCommand& command) {
  const bool is_all = command.node == 0;
  const Micros timeout = options.common.timeout * millisecond;
  std::optional<HeartbeatTime> before;
  if (!is_all && command.state == stopped_state) {  // it answers no SDO afterwards
    before = read_heartbeat_time(session, options.common.timeout);
  }
  if (session.is_interrupted()) {
    print_message("interrupted; nothing was sent");
    return interrupted;
  }
  if (!send_command(session.bus(), session.host(), command.specifier, command.node, timeout)) {
    return report_unsent(session);
  }
  if (is_all) {
    flush(session.bus(), session.host());
  }
  const int status = is_all ? int{ok} : report_state(session, command.node, command, options.common, before);
  if (!session.bus().refusal().empty()) {
    print_message(session.bus().refusal() + ": the command was not sent");
    return bus_fault;
  }
  if (status == ok && is_all && !options.common.is_json) {
    print(fmt::format("{} was sent to all nodes\n", command.name));
  }
  if (options.common.is_json) {
    const nlohmann::json json = {{"command", command.name},
                                 {"node", is_all ? nlohmann::json("all") : nlohmann::json(command.node)},
                                 {"done", status == ok}};
    print(json.dump() + '\n');
  }
  return status;
}

namespace {

int run_nmt(NmtOptions& options) {
  if (!place_node(options.common, {&options.node})) {
    return usage;
  }
  const std::optional<StateCommand> command = state_command(options);
  if (!command) {
    return usage;
  }
  int status = ok;
  std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  {
    const Interruption interruption;
    status = agree(*bus, options, *command);
  }
  if (status != ok) {
    return status;
  }
  Session session(std::move(bus), command->node == 0 ? std::uint8_t{127} : command->node);
  return change_state(session, options, *command);
}

}  // namespace

Verb add_nmt(CommandLine& line) {
  const auto options = std::make_shared<NmtOptions>();
  Arguments arguments = line.add_command("nmt", "Change the NMT state of a device, or of all");
  std::vector<std::string> words;
  for (const StateCommand& command : commands) {
    words.emplace_back(command.name);
  }
  arguments.add_option("command", options->command, "start, stop, preop, reset or reset-comm").required().one_of(words);
  arguments.add_option("node", options->node, "Node-ID, 1 to 127, or all");
  add_bus_options(arguments, options->common);
  add_node_option(arguments, options->common);
  add_timeout_option(arguments, options->common, 2000);
  arguments.end_help(
      "Examples:\n"
      "  lexican nmt start 5 -i can0\n"
      "  lexican nmt reset all --yes -i can0");
  return {arguments, [options] { return finish(options->common, run_nmt(*options)); }};
}

}  // namespace lexican::program
