// SPDX-License-Identifier: Apache-2.0
#include "codict/program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "codict/directory.hpp"

namespace test {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

Ran run_codict(const std::string& directory, const std::string& arguments) {
  const Directory output;
  const std::string command = "cd '" + directory + "' && '" LEXICAN_CODICT_PROGRAM "' " + arguments + " >'" +
                              output / "out" + "' 2>'" + output / "err" + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(output / "out"), bytes_of(output / "err")};
}

}  // namespace test
