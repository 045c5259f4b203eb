// SPDX-License-Identifier: Apache-2.0
/// \file verify.hpp
/// codict gen --verify: compiles the generated dictionary with the stack and starts a node with it.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "gen/gen.hpp"

namespace lexican::codict::cli {

struct VerifyOptions {
  bool is_wanted = false;
  std::string stack;                     ///< directory with the sources of the stack
  std::string preset = "slave";          ///< name of a file in config/presets
  std::vector<std::string> definitions;  ///< "CO_RPDO_N=8"
  std::string build_directory;           ///< directory for the compiled stack; empty: a temporary one
};

void add_verify(Arguments& command, VerifyOptions& options);

/// Checks the options. Returns false after a message if they cannot be used.
bool check_verify(const VerifyOptions& options);

/// Builds and runs the program. Prints the errors that the stack reports; returns clean if there are none.
Status verify(const gen::Output& output, const gen::Options& gen, const VerifyOptions& options);

}  // namespace lexican::codict::cli
