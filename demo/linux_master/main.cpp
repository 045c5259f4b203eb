// SPDX-License-Identifier: Apache-2.0
// lexican-demo-master: reads or writes one object of a CANopen node, with the stack's SDO client, or gives node-IDs
// with its LSS master.
#include <unistd.h>

#include <iostream>

#include "host/linux_host.hpp"
#include "linux_master/lss.hpp"
#include "linux_master/options.hpp"
#include "linux_master/request.hpp"

namespace demo {
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
    SocketCanHost host(interruption);
    if (const std::string fault = host.open(line.interface, false, true); !fault.empty()) {
      return refuse(fault);
    }
    outcome = carry_out(prepared.request, host, progress_form(line.progress), std::cerr);
  }
  return report(prepared.request, outcome, std::cout, std::cerr);
}

int run_lss(const CommandLine& line) {
  const LssPrepared prepared = prepare(line.lss);
  if (!prepared.fault.empty()) {
    return refuse(prepared.fault);
  }
  const Interruption interruption;
  SocketCanHost host(interruption);
  if (const std::string fault = host.open(line.interface, false, true); !fault.empty()) {
    return refuse(fault);
  }
  return carry_out(prepared.request, host, std::cout, std::cerr);
}

}  // namespace
}  // namespace demo

int main(int argc, char** argv) {
  const demo::CommandLine line = demo::read_command_line(argc, argv);
  if (!line.run) {
    return line.exit_code;
  }
  return line.is_lss ? demo::run_lss(line) : demo::run(line);
}
