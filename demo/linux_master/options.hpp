// SPDX-License-Identifier: Apache-2.0
/// \file options.hpp
/// The command line of lexican-demo-master.
#pragma once

#include <string>

#include "host/exit.hpp"
#include "linux_master/arguments.hpp"

namespace demo {

struct CommandLine {
  Arguments arguments;
  LssArguments lss;
  bool is_lss = false;
  std::string interface = "vcan0";
  bool progress = false;
  bool run = false;  // false: all is said (--help, or a fault), end with exit_code
  int exit_code = exit_ok;
};

CommandLine read_command_line(int argc, char** argv);

}  // namespace demo
