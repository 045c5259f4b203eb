// SPDX-License-Identifier: Apache-2.0
// lexican sim: runs the device of a description on a bus.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>

#include "model/pdo.hpp"
#include "program/session.hpp"
#include "simulate/ports.hpp"
#include "simulate/simulation.hpp"
#include "text/file.hpp"

namespace lexican::program {
namespace {

struct SimOptions {
  Common common;
  std::string file;
  std::string node;
  std::string script;
  std::string storage;
  std::uint32_t count = 1;
  std::uint64_t seed = 1;
};

/// A bus in real time.
class RealGround : public simulate::Ground {
 public:
  RealGround(host_bus::Bus& bus, const Interruption& interruption)
      : bus_(bus), ports_(bus), interruption_(interruption) {}

  Can add_can() override {
    hosts_.push_back(std::make_unique<BusHost>(ports_.add(), interruption_, BusHost::Role::device));
    return hosts_.back()->device_can();
  }
  Timer add_timer() override { return hosts_.back()->device_timer(); }
  Micros now() override { return host_bus::clock_now(CLOCK_MONOTONIC); }
  bool carries_error_frames() override { return !bus_.is_physical(); }

 private:
  host_bus::Bus& bus_;
  simulate::Ports ports_;
  const Interruption& interruption_;
  std::vector<std::unique_ptr<BusHost>> hosts_;
};

/// Reads the lines of the standard input as they come.
class SimInput {
 public:
  SimInput() : is_terminal_(isatty(STDIN_FILENO) != 0) {}

  pollfd wanted() const { return {has_ended_ ? -1 : STDIN_FILENO, POLLIN, 0}; }
  bool is_terminal() const { return is_terminal_; }
  void prompt() const {
    if (is_terminal_) {
      std::fputs("sim> ", stdout);
      std::fflush(stdout);
    }
  }
  /// Calls \a execute for each complete line that can be read without waiting.
  template <typename Execute>
  void read(Execute execute) {
    char buffer[4096];
    const ssize_t size = ::read(STDIN_FILENO, buffer, sizeof buffer);
    has_ended_ = size <= 0;
    text_.append(buffer, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    constexpr std::size_t longest = 65536;
    text_ = text_.size() > longest && text_.find('\n') == std::string::npos ? std::string() : text_;
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      const std::string line = text_.substr(0, end);
      text_.erase(0, end + 1);
      execute(line);
      prompt();
    }
  }

 private:
  bool is_terminal_;
  bool has_ended_ = false;
  std::string text_;
};

bool find_simulated(const std::string& word, const describe::Description& description, std::uint16_t& index,
                    std::uint8_t& sub_index, std::string& why) {
  ObjectReference found;
  const bool is_found = find_object(word, description, found, why);
  index = found.index;
  sub_index = found.sub_index;
  return is_found;
}

std::string introduction(simulate::Device& device, const std::string& bus, unsigned count) {
  const codict::Device& description = *device.description().device();
  const std::uint8_t node = device.node().stack().NodeId;
  unsigned transmit = 0;
  unsigned receive = 0;
  for (const codict::Pdo& pdo : codict::pdos_of(description)) {
    ++(pdo.is_transmit ? transmit : receive);
  }
  const std::string name = description.identity.product_name.text;
  std::string text = node <= 127 ? fmt::format("node {}", node) : "device without node-ID";
  if (count > 1 && node <= 127) {
    text = fmt::format("nodes {} to {}", node, node + count - 1);
  } else if (count > 1) {
    text = fmt::format("{} devices without node-ID", count);
  }
  return text + (name.empty() ? "" : " \"" + name + '"') +
         fmt::format(" on {}: {} entries, {} TPDOs, {} RPDOs\n", bus, device.dictionary().entries(), transmit, receive);
}

int run_devices(const SimOptions& options, simulate::Simulation& simulation, host_bus::Bus& bus,
                const Interruption& interruption) {
  SimInput input;
  simulation.on_note(print_note);
  const auto execute = [&](const std::string& line) {
    bool is_fault = false;
    const std::string answer = simulation.execute(line, is_fault);
    if (!answer.empty()) {
      is_fault ? print_note(answer) : print(answer + '\n');
      std::fflush(stdout);
    }
    return !is_fault;
  };
  if (!options.script.empty()) {
    std::string why;
    const std::optional<codict::Source> script = codict::read_file(options.script, why);
    if (!script) {
      print_message(why);
      return usage;
    }
    std::istringstream lines{std::string(script->bytes())};
    unsigned number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (!execute(line)) {
        print_message(fmt::format("{}, line {}: {}", options.script, number, line));
        return usage;
      }
    }
  }
  std::fflush(stdout);
  input.prompt();
  while (!Interruption::happened() && !simulation.has_ended()) {
    const Micros wait = simulation.process();
    pollfd wanted[] = {bus.wanted(), input.wanted()};
    timespec timeout{static_cast<time_t>(wait / second), static_cast<long>(wait % second * 1000)};
    if (ppoll(wanted, 2, &timeout, &interruption.while_waiting()) > 0 && wanted[1].revents != 0) {
      input.read(execute);
    }
  }
  if (input.is_terminal()) {
    std::fputs("\n", stdout);
  }
  return ok;
}

int run_sim(SimOptions& options) {
  std::string why;
  const std::optional<codict::Source> file = codict::read_file(options.file, why);
  const std::optional<describe::Description> description =
      file ? describe::read_description(options.file, why) : std::nullopt;
  if (!description) {
    print_message(why);
    return usage;
  }
  simulate::SimulationSetup setup;
  const std::uint8_t commissioned = description->device()->commissioning.node_id.value;
  const bool is_unconfigured = options.node == "none";
  setup.node_id = is_unconfigured        ? no_node_id
                  : options.node.empty() ? (commissioned >= 1 && commissioned <= 127 ? commissioned : std::uint8_t{1})
                                         : node_of(options.node);
  if (setup.node_id == 0 || (setup.node_id <= 127 && setup.node_id + options.count > 128)) {
    print_message(setup.node_id == 0
                      ? "'" + options.node + "' is no node-ID, which is 1 to 127, or none for a device without"
                      : fmt::format("{} devices from node {} on go beyond node-ID 127", options.count, setup.node_id));
    return usage;
  }
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, false, status);
  if (bus == nullptr) {
    return status;
  }
  setup.description = *description;
  setup.file = std::string(file->bytes());
  setup.count = options.count;
  setup.storage = options.storage;
  setup.seed = options.seed;
  const Interruption interruption;
  RealGround ground(*bus, interruption);
  simulate::Simulation simulation(ground, setup, find_simulated);
  why = simulation.start();
  if (!why.empty()) {
    print_message(options.file + ": " + why);
    return usage;
  }
  for (const std::string& line : simulation.device(0).dictionary().left_out()) {
    print_note(line);
  }
  if (!simulation.device(0).fault().empty()) {
    print_note(simulation.device(0).fault());
  }
  const char* const usual = std::getenv("LEXICAN_BUS");
  print(introduction(simulation.device(0), !options.common.bus.empty() ? options.common.bus : usual, options.count));
  return run_devices(options, simulation, *bus, interruption);
}

}  // namespace

Verb add_sim(CommandLine& line) {
  const auto options = std::make_shared<SimOptions>();
  Arguments arguments = line.add_command("sim", "Simulate the device of a description");
  arguments.add_option("file", options->file, "EDS, DCF, XDD or XDC").required();
  arguments.add_option("-n,--node", options->node,
                       "Node-ID, or none for an LSS slave; default: that of the DCF, else 1");
  arguments.add_option("--count", options->count, "Number of devices, with consecutive node-IDs").in_range(1, 127);
  arguments.add_option("--store", options->storage, "File that keeps what is stored by 1010h and LSS");
  arguments.add_option("--script", options->script, "File with commands, which are executed at the begin");
  arguments.add_option("--seed", options->seed, "Begin of the random numbers for lost and repeated frames");
  add_bus_options(arguments, options->common);
  arguments.end_help(
      "Examples:\n"
      "  lexican sim drive.eds --node 5 -i hub:bench\n"
      "  lexican sim drive.eds --node 10 --count 20 -i hub:bench@500k");
  return {arguments, [options] { return finish(options->common, run_sim(*options)); }};
}

}  // namespace lexican::program
