// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// The program codict, run by a shell as its user runs it.
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

/// A command of the shell.
Ran run_shell(const std::string& command);
/// directory: in which it is run.
Ran run_codict(const std::string& directory, const std::string& arguments);
/// In that of the fixtures.
Ran run(const std::string& arguments);

/// A copy of a fixture; its path.
std::string copy_to(const Directory& directory, const char* fixture);

bool has(const std::string& text, const std::string& part);

}  // namespace test
