// SPDX-License-Identifier: Apache-2.0
/// \file output.hpp
/// Files that commands make.
#pragma once

#include <string>
#include <string_view>

#include "cli/command.hpp"

namespace lexican::codict::cli {

/// Whole or not at all, and not touched if it has these bytes already; "-" is the standard output.
Status write_output(const std::string& path, std::string_view bytes);

/// Creates a directory and those above it. False, with a message, if that fails.
bool make_directory(const std::string& path);

/// Whether two paths lead to one file, "-" to none.
bool is_same_file(const std::string& a, const std::string& b);

/// "html" of "docs/drive.HTML"; empty if there is none.
std::string ending_of(std::string_view path);

}  // namespace lexican::codict::cli
