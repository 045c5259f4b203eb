// SPDX-License-Identifier: Apache-2.0
/// \file options.hpp
/// The command line of lexican-demo-master.
#pragma once

#include <cstdint>
#include <string>

#include "client/arguments.hpp"
#include "host/exit.hpp"

namespace lexican::demo {

enum class Work { transfer, nmt, lss, tour };

struct CommandLine {
  Work work = Work::transfer;
  Arguments arguments;
  NmtArguments nmt;
  LssArguments lss;
  std::string bus;           // empty: vcan0, else hub:demo
  bool every_frame = false;  // option of the tour
  bool progress = false;
  bool run = false;  // false: end with exit_code (--help, or a fault)
  int exit_code = exit_ok;
};

CommandLine read_command_line(int argc, char** argv);

}  // namespace lexican::demo
