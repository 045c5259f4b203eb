// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// Runs the program codict in a shell.
#pragma once

#include <filesystem>
#include <string>

#include "directory.hpp"

namespace test {

std::string bytes_of(const std::filesystem::path& path);  ///< empty if there is no such file
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

struct Ran {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a command of the shell.
Ran run_shell(const std::string& command);
/// Runs codict in a directory.
Ran run_codict(const std::string& directory, const std::string& arguments);
/// Runs codict in the directory of the fixtures.
Ran run(const std::string& arguments);

/// Copies a fixture to a directory and returns the path of the copy.
std::string copy_to(const Directory& directory, const char* fixture);

bool has(const std::string& text, const std::string& part);

}  // namespace test
