// SPDX-License-Identifier: Apache-2.0
// lexican-demo-master: reads or writes one object of a CANopen node, sends an NMT command, finds and configures nodes
// by LSS, or runs the tour of a demo clock. The library lexican_demo_client (demo/client) executes the requests.
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <utility>

#include "client/lss.hpp"
#include "client/nmt.hpp"
#include "client/request.hpp"
#include "host/linux_host.hpp"
#include "host/slcan_host.hpp"
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

/// The bus to use; or no host, and the fault.
struct Bus {
  std::unique_ptr<Host> host;
  std::string fault;
};

template <typename Kind>
Bus opened(std::unique_ptr<Kind> host, std::string fault) {
  return {fault.empty() ? std::move(host) : nullptr, std::move(fault)};
}

Bus open_bus(const CommandLine& line, const Interruption& interruption) {
  if (line.slcan.empty()) {
    auto host = std::make_unique<SocketCanHost>(interruption);
    std::string fault = host->open(line.interface, false, true);
    return opened(std::move(host), std::move(fault));
  }
  auto host = std::make_unique<SlcanHost>(interruption);
  std::string fault = host->open(line.slcan, line.bit_rate);
  return opened(std::move(host), std::move(fault));
}

int run(const CommandLine& line) {
  const Prepared prepared = prepare(line.arguments);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  Outcome outcome;
  {
    const Interruption interruption;
    const Bus bus = open_bus(line, interruption);
    if (bus.host == nullptr) {
      return refuse(bus.fault);
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
  const Bus bus = open_bus(line, interruption);
  return bus.host == nullptr ? refuse(bus.fault) : carry_out(prepared.request, *bus.host, std::cerr);
}

int run_lss(const CommandLine& line) {
  const LssPrepared prepared = prepare(line.lss);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  const Bus bus = open_bus(line, interruption);
  return bus.host == nullptr ? refuse(bus.fault) : carry_out(prepared.request, *bus.host, std::cout, std::cerr);
}

int run_tour(const CommandLine& line) {
  const TourPrepared prepared = prepare_tour(line.arguments);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  const Bus bus = open_bus(line, interruption);
  if (bus.host == nullptr) {
    return refuse(bus.fault);
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
