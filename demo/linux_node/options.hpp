// SPDX-License-Identifier: Apache-2.0
/// \file options.hpp
/// The command line of lexican-demo-node.
#pragma once

#include <cstdint>
#include <string>

#include "host/exit.hpp"

namespace lexican::demo {

struct Options {
  std::string bus;  // empty: automatic
  std::uint8_t node_id = 1;
  bool unconfigured = false;  // the node starts without node-ID
  std::string storage;        // file; empty: none
  std::string serial;         // number as typed; empty: automatic
  bool serve = false;
  bool virtual_bus = false;
  bool every_frame = false;
  bool quiet = false;
};

struct CommandLine {
  Options options;
  bool run = false;  // false: end with exit_code (--help, or a fault)
  int exit_code = exit_ok;
};

CommandLine read_command_line(int argc, char** argv);

}  // namespace lexican::demo
