// SPDX-License-Identifier: Apache-2.0
// lexican-demo-node: the clock as a CANopen node, alone or with a master that demonstrates its functions.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <random>

#include "clock/dictionary.hpp"
#include "clock/names.hpp"
#include "host/named_bus.hpp"
#include "host/virtual_bus_host.hpp"
#include "linux_node/clock.hpp"
#include "linux_node/heartbeat_watch.hpp"
#include "linux_node/options.hpp"
#include "linux_node/storage.hpp"
#include "tour/tour.hpp"
#include "tour/view.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr bool tour_begins_with_lss = USE_LSS != 0 && USE_LSS_MASTER != 0;
constexpr std::uint32_t ticks_per_millisecond = Node::ticks_per_second / 1000;

/// Opens the bus of the options. The node without options uses vcan0 if it is up; without it, alone hub:demo, and with
/// its master the bus inside the program.
NamedBus choose_bus(const Options& options, const Interruption& interruption) {
  NamedBus bus;
  if (options.virtual_bus) {
    bus.about = "selected by --virtual";
  } else if (options.serve) {
    return open_bus(options.bus, Ends::device, interruption);
  } else {
    bus = open_bus(options.bus.empty() ? default_interface : options.bus, Ends::both, interruption);
  }
  if (bus.host == nullptr && options.bus.empty()) {
    bus.host = std::make_unique<VirtualBusHost>(interruption);
    bus.about = text("built-in virtual bus, %u kbit/s, simulated time", VirtualBusHost::bit_rate / 1000) +
                (options.virtual_bus ? ", " : "; ") + bus.about;
  }
  return bus;
}

View::Style style_for(const Options& options) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  const bool colours = terminal && std::getenv("NO_COLOR") == nullptr;
  return {terminal, colours, options.every_frame, options.serve ? "bus" : "master"};
}

std::string open_storage(Storage& storage, const Options& options) {
  if (!options.serve) {
    return storage.open_temporary();
  }
  return options.storage.empty() ? std::string() : storage.open(options.storage);
}

/// Returns the node-ID of the node at its start.
std::uint8_t first_node_id(const Options& options) {
  const bool is_unconfigured = options.serve ? options.unconfigured : tour_begins_with_lss;
  return is_unconfigured ? no_node_id : options.node_id;
}

/// Returns a serial number. Two nodes on a bus need different LSS addresses; the storage file identifies a node across
/// restarts.
std::uint32_t serial_number(const Options& options) {
  if (!options.serial.empty()) {
    return static_cast<std::uint32_t>(std::stoul(options.serial, nullptr, 0));
  }
  if (!options.serve) {
    return clock_serial_number;
  }
  if (options.storage.empty()) {
    return serial_number_from(std::to_string(std::random_device()()));
  }
  char host[256] = "";
  (void)::gethostname(host, sizeof host - 1);
  return serial_number_from(std::string(host) + ":" + std::filesystem::absolute(options.storage).string());
}

std::string about_node(Clock& clock, const Options& options, std::uint32_t serial) {
  return "Node: the demo clock, " +
         (clock.node_id() == no_node_id ? "without node-ID" : text("node-ID %u", clock.node_id())) +
         (options.serve ? text(", serial number 0x%08X; Ctrl-C ends it\n", serial) : "\n");
}

/// Returns a first command for a master on the same bus.
std::string about_master(Clock& clock, const NamedBus& bus, const Options& options) {
  const std::string master = "Master: demo/run master -i " + bus.name_for_others;
  if (clock.node_id() == no_node_id) {
    return master + " lss set-id 5" + (options.storage.empty() ? "" : " --store");
  }
  return master + text(" --node %u --index 1008 read", clock.node_id());
}

void print_lost_frames(Host& host, View& view) {
  if (host.lost_frames() != 0) {
    view.note("", text("%u frames lost before the program could read them: the receive queue of the socket was full",
                       host.lost_frames()));
  }
}

/// Runs the tour: the master uses the functions of the node one after the other. Returns the exit status.
int show_tour(Host& host, Clock& clock, const Options& options, View& view) {
  Master master(host, clock, options.node_id);
  const TourResult result = run_tour(clock, master, view);
  print_summary(result, clock.node().counters(), view);
  print_lost_frames(host, view);
  if (!result.failed.empty() && !host.bus_fault().empty()) {
    view.finding(false, host.bus_fault());
  }
  if (result.interrupted) {
    return exit_interrupted;
  }
  return result.failed.empty() ? exit_ok : exit_failed;
}

/// Prints a fault of the bus. It is printed again only after frames have been transferred.
class FaultReport {
 public:
  void update(Host& host, Clock& clock, View& view) {
    const CO_NODE_COUNTERS counters = clock.node().counters();
    if (clock.node().error() == CO_ERR_NONE) {
      shown_ = shown_ && frames_ == counters.Sent + counters.Received;
    } else if (!shown_ && !host.bus_fault().empty()) {
      view.line(host.bus_fault());
      shown_ = true;
    }
    frames_ = counters.Sent + counters.Received;
  }

 private:
  bool shown_ = false;
  std::uint32_t frames_ = 0;
};

/// Runs the node until Ctrl-C. Returns the exit status.
int serve(Host& host, Clock& clock, const HeartbeatWatch& heartbeats, View& view) {
  if (!clock.start()) {
    view.line("the node does not start: " + clock.node().error_text());
    return exit_failed;
  }
  FaultReport faults;
  while (!host.interrupted()) {
    clock.node().process();
    faults.update(host, clock, view);
    host.wait(clock.node().due_in());
  }
  view.line("\nSummary");
  print_counters(clock.node().counters(), view);
  print_lost_frames(host, view);
  view.note("", text("%u heartbeats, greatest lateness %u us", heartbeats.number(), heartbeats.greatest_lateness()));
  return exit_ok;
}

int run(const Options& options) {
  const Interruption interruption;
  const NamedBus bus = choose_bus(options, interruption);
  if (bus.host == nullptr) {
    std::cerr << bus.about << '\n';
    return exit_usage;
  }
  Storage storage;
  if (const std::string fault = open_storage(storage, options); !fault.empty()) {
    std::cerr << fault << '\n';
    return exit_usage;
  }
  Host& host = *bus.host;
  View view(std::cout, clock_object_names(), style_for(options), clock_mappings());
  const Micros begin = host.now();
  const Timer timer = host.device_timer();
  HeartbeatWatch heartbeats;
  const Node::Observer observer = [&](bool received, const CO_IF_FRM& frame) {
    if (!received) {
      heartbeats.on_sent(frame, timer.driver->Now(timer.context),
                         clock_ram.producer_heartbeat_time * ticks_per_millisecond);
    }
    if (!options.quiet) {
      view.frame(host.now() - begin, received, frame);
    }
  };
  const std::uint32_t serial = serial_number(options);
  Clock clock(first_node_id(options), host.device_can(), timer, observer, storage.memory(), serial);
  view.line("Bus:  " + bus.about);
  if (options.serve) {
    view.line(about_master(clock, bus, options));
  }
  view.line(about_node(clock, options, serial));
  view.columns();
  return options.serve ? serve(host, clock, heartbeats, view) : show_tour(host, clock, options, view);
}

}  // namespace
}  // namespace lexican::demo

int main(int argc, char** argv) {
  const lexican::demo::CommandLine line = lexican::demo::read_command_line(argc, argv);
  return line.run ? lexican::demo::run(line.options) : line.exit_code;
}
