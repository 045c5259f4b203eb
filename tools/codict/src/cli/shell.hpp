// SPDX-License-Identifier: Apache-2.0
/// \file shell.hpp
/// Texts for the user's shell, generated from the commands and options that a program parses.
#pragma once

#include <string>
#include <string_view>

#include "cli/arguments.hpp"

namespace lexican::codict::cli {

/// Returns the script that completes commands and options in bash, zsh or fish.
std::string completion(const CommandLine& line, std::string_view shell);

/// Returns the manual page in roff. \a about: of its section NAME, in lower case without a full stop.
std::string manual(const CommandLine& line, std::string_view about, std::string_view version);

}  // namespace lexican::codict::cli
