// SPDX-License-Identifier: Apache-2.0
// lexican why: names the causes of faults on a bus, or in a log.
#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bus/clock.hpp"
#include "explain/explainer.hpp"
#include "program/identity.hpp"
#include "program/verb.hpp"

namespace lexican::program {
namespace {

using explain::Finding;
using host_bus::Micros;

constexpr Micros settled = 2'000'000;  // age of a cause that is shown at once: its consequences are known

struct WhyOptions {
  Common common;
  std::string log;  ///< positional: a log instead of a bus
  std::vector<std::string> nodes;
};

class Why {
 public:
  Why(const WhyOptions& options, describe::Network& network, std::uint32_t bit_rate)
      : options_(options),
        described_(network),
        explainer_(network, bit_rate, [this](std::uint8_t node, const describe::Identity& identity) {
          return described_.describe(node, identity);
        }) {
    for (const std::string& node : options.nodes) {
      nodes_.insert(node_of(node));
    }
  }

  int run(host_bus::Bus& bus) {
    const Interruption interruption;
    const bool is_log = bus.log() != nullptr;
    while (!Interruption::happened()) {
      while (const std::optional<host_bus::Entry> entry = bus.receive()) {
        explainer_.process(*entry);
        if (Interruption::happened()) {
          break;
        }
      }
      if (bus.wanted().fd < 0 && is_log) {
        break;
      }
      if (bus.wanted().fd < 0) {
        lost_.reopen(bus);
      }
      if (!is_log) {
        explainer_.advance(host_bus::clock_now(CLOCK_REALTIME));
        show(host_bus::clock_now(CLOCK_REALTIME));
        std::fflush(stdout);
      }
      pollfd wanted = bus.wanted();
      constexpr timespec timeout{0, 200'000'000};
      ppoll(&wanted, 1, &timeout, &interruption.while_waiting());
    }
    explainer_.finish();
    show(host_bus::max_time);
    return finish(bus);
  }

 private:
  bool is_wanted(const Finding& finding) const {
    return nodes_.empty() || finding.node == 0 || nodes_.count(finding.node) != 0;
  }

  /// Shows the causes that are new, in the order of their begin. \a now: those that are younger wait.
  void show(Micros now) {
    std::vector<Finding> all = explainer_.findings();
    std::stable_sort(all.begin(), all.end(),
                     [](const Finding& a, const Finding& b) { return a.evidence.since() < b.evidence.since(); });
    for (const Finding& finding : all) {
      const explain::Findings::Key key{finding.cause, finding.node, finding.detail};
      const Micros found = found_.try_emplace(key, now).first->second;
      const bool is_settled = now == host_bus::max_time || found + settled <= now;
      if (is_wanted(finding) && is_settled && shown_.insert(key).second) {
        options_.common.is_json ? print_json(finding) : print_text(finding);
      }
    }
  }

  double seconds(Micros time) const {
    const Micros first = explainer_.statistics().first;
    return time < first ? 0.0 : static_cast<double>(time - first) / 1e6;
  }

  void print_text(const Finding& finding) {
    print(fmt::format("{} {} (since {:.3f} s)\n  {}\n", shown_.size(), finding.title, seconds(finding.evidence.since()),
                      finding.text));
    for (const explain::ShownFrame& frame : finding.evidence.frames()) {
      print(fmt::format("  {:10.3f} {}\n", seconds(frame.time), frame.text));
    }
    print(fmt::format("  check: {}\n", finding.check));
    if (!finding.fix.empty()) {
      print(fmt::format("  fix: {}\n", finding.fix));
    }
    print(fmt::format("  page: {}\n\n", explain::cause_of(finding.cause).name));
  }

  void print_json(const Finding& finding) const {
    nlohmann::json frames = nlohmann::json::array();
    for (const explain::ShownFrame& frame : finding.evidence.frames()) {
      frames.push_back({{"time", seconds(frame.time)}, {"text", frame.text}});
    }
    nlohmann::json json = {{"cause", explain::cause_of(finding.cause).name},
                           {"title", finding.title},
                           {"text", finding.text},
                           {"since", seconds(finding.evidence.since())},
                           {"until", seconds(finding.evidence.until())},
                           {"frames", frames},
                           {"check", finding.check}};
    if (!finding.fix.empty()) {
      json["fix"] = finding.fix;
    }
    if (finding.node != 0) {
      json["node"] = finding.node;
    }
    print(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }

  int finish(const host_bus::Bus& bus) const {
    const describe::Statistics& numbers = explainer_.statistics();
    if (bus.log() != nullptr && !bus.log()->fault().empty()) {
      print_message(bus.log()->fault());
      return usage;
    }
    if (numbers.frames + numbers.errors == 0) {
      print_message(bus.log() != nullptr ? "the log has no frames" : "no frame was received: see lexican scan");
      return no_answer;
    }
    if (explainer_.is_cut()) {
      print_message("there are more findings of some causes than are shown");
    }
    if (!shown_.empty()) {
      return refused;
    }
    if (!options_.common.is_json) {
      print(fmt::format("no known cause of a fault{} in {} frames, {:.3f} s", nodes_.empty() ? "" : " of these nodes",
                        numbers.frames, seconds(numbers.last)) +
            (explainer_.faults() == 0
                 ? "\n"
                 : fmt::format("; {} lines that lexican mon shows as faults have no cause that is known\n",
                               explainer_.faults())));
    }
    return ok;
  }

  const WhyOptions& options_;
  LibraryFiles described_;
  explain::Explainer explainer_;
  LostBus lost_;
  std::set<unsigned> nodes_;
  std::set<explain::Findings::Key> shown_;
  std::map<explain::Findings::Key, Micros> found_;  ///< time at which it was found
};

int run_why(WhyOptions& options) {
  if (!options.log.empty() && !options.common.bus.empty()) {
    print_message("give a log, or -i, and not both");
    return usage;
  }
  if (!options.log.empty()) {
    options.common.bus = "replay:" + options.log;
  }
  describe::Network network;
  if (!read_descriptions(options.common, network)) {
    return usage;
  }
  if (!are_nodes(options.nodes)) {
    return usage;
  }
  int status = ok;
  const std::unique_ptr<host_bus::Bus> bus = open_bus(options.common, true, status);
  if (bus == nullptr) {
    return status;
  }
  return Why(options, network, options.common.rate.empty() ? bus->bit_rate() : bit_rate_of(options.common.rate))
      .run(*bus);
}

}  // namespace

Verb add_why(CommandLine& line) {
  const auto options = std::make_shared<WhyOptions>();
  Arguments arguments = line.add_command("why", "Name the causes of faults on a bus, or in a log");
  arguments.add_option("file", options->log,
                       "Log of candump, pcapng, pcap or ASC instead of a bus, - for standard input");
  add_bus_options(arguments, options->common);
  add_eds_option(arguments, options->common);
  arguments.add_option("-n,--node", options->nodes, "Only causes of these nodes, and of the bus").single_values();
  arguments.add_flag("--ack", options->common.acknowledges,
                     "Acknowledge frames, for a device that is alone on the bus");
  arguments.end_help(
      "Examples:\n"
      "  lexican why fault.log --eds 5=drive.eds\n"
      "  lexican why -i can0 --node 5\n"
      "  lexican why fault.pcapng --rate 500k --json");
  return {arguments, [options] {
            const int status = run_why(*options);
            return status == refused ? refused : program::finish(options->common, status);  // a cause is no failure
          }};
}

}  // namespace lexican::program
