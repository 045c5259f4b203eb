// SPDX-License-Identifier: Apache-2.0
/// \file directory.hpp
/// Temporary directory, which the destructor removes.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

namespace test {

class Directory {
 public:
  Directory() {
    std::string name = std::filesystem::temp_directory_path() / "codict-XXXXXX";
    path_ = ::mkdtemp(name.data());
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  std::string operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace test
