// SPDX-License-Identifier: Apache-2.0
// lexican-demo-master: reads or writes one object of a CANopen node, sends an NMT command, finds and configures nodes
// by LSS, or runs the tour of a demo clock. The library lexican_client (tools/lexican/src/client) executes the
// requests.
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "client/lss.hpp"
#include "client/nmt.hpp"
#include "client/request.hpp"
#include "host/named_bus.hpp"
#include "linux_master/options.hpp"
#include "linux_master/tour.hpp"

namespace lexican::demo {
namespace {

int refuse(const std::string& fault) {
  std::cerr << fault << '\n';
  return exit_usage;
}

Progress::Form progress_form(bool asked_for) {
  if (isatty(STDERR_FILENO) != 0) {
    return Progress::Form::bar;
  }
  return asked_for ? Progress::Form::lines : Progress::Form::none;
}

int run(const CommandLine& line) {
  const Prepared prepared = prepare(line.arguments);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  Outcome outcome;
  {
    const Interruption interruption;
    const NamedBus bus = open_bus(line.bus, Ends::master, interruption);
    if (bus.host == nullptr) {
      return refuse(bus.about);
    }
    outcome = carry_out(prepared.request, *bus.host, progress_form(line.progress), std::cerr);
  }
  return report(prepared.request, outcome, std::cout, std::cerr);
}

int run_nmt(const CommandLine& line) {
  const NmtPrepared prepared = prepare(line.nmt);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  const NamedBus bus = open_bus(line.bus, Ends::master, interruption);
  return bus.host == nullptr ? refuse(bus.about) : carry_out(prepared.request, *bus.host, std::cerr);
}

int run_lss(const CommandLine& line) {
  const LssPrepared prepared = prepare(line.lss);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  const NamedBus bus = open_bus(line.bus, Ends::master, interruption);
  return bus.host == nullptr ? refuse(bus.about) : carry_out(prepared.request, *bus.host, std::cout, std::cerr);
}

int run_tour(const CommandLine& line) {
  const TourPrepared prepared = prepare_tour(line.arguments);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  const NamedBus bus = open_bus(line.bus, Ends::master, interruption);
  if (bus.host == nullptr) {
    return refuse(bus.about);
  }
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  const View::Style style = {terminal, terminal && std::getenv("NO_COLOR") == nullptr, line.every_frame, "master"};
  return run_clock_tour(prepared.node, *bus.host, style, std::cout);
}

int run_any(const CommandLine& line) {
  if (line.every_frame && line.work != Work::tour) {
    return refuse("--every-frame: only tour shows frames");
  }
  switch (line.work) {
    case Work::nmt: return run_nmt(line);
    case Work::lss: return run_lss(line);
    case Work::tour: return run_tour(line);
    default: return run(line);
  }
}

}  // namespace
}  // namespace lexican::demo

int main(int argc, char** argv) {
  const lexican::demo::CommandLine line = lexican::demo::read_command_line(argc, argv);
  if (!line.run) {
    return line.exit_code;
  }
  return lexican::demo::run_any(line);
}
