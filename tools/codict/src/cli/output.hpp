// SPDX-License-Identifier: Apache-2.0
/// \file output.hpp
/// Files that commands write.
#pragma once

#include <string>
#include <string_view>

#include "cli/command.hpp"

namespace lexican::codict::cli {

/// Writes a file atomically, or leaves it unchanged if it already contains these bytes; "-" is the standard output.
Status write_output(const std::string& path, std::string_view bytes);

/// Creates a directory and its parents. Returns false after a message if that fails.
bool make_directory(const std::string& path);

/// Returns true if both paths refer to the same file; "-" refers to no file.
bool is_same_file(const std::string& a, const std::string& b);

/// Returns the file extension in lower case: "html" for "docs/drive.HTML"; empty if there is none.
std::string ending_of(std::string_view path);

}  // namespace lexican::codict::cli
