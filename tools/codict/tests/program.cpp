// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "reading.hpp"

namespace test {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

Ran run_shell(const std::string& command) {
  const Directory output;
  const std::string redirected = "{ " + command + "\n} >'" + output / "out" + "' 2>'" + output / "err" + "'";
  const int status = std::system(redirected.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(output / "out"), bytes_of(output / "err")};
}

std::string copy_to(const Directory& directory, const char* fixture) {
  const std::string path = directory / std::filesystem::path(fixture).filename().c_str();
  std::filesystem::copy_file(test::fixture(fixture), path);
  return path;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace test
