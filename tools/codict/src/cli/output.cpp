// SPDX-License-Identifier: Apache-2.0
#include "cli/output.hpp"

#include <filesystem>
#include <system_error>

#include "text/file.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

Status write_output(const std::string& path, std::string_view bytes) {
  std::string why;
  const Written written = write_file(path, bytes, why);
  if (!why.empty()) {
    print_message(why);
  }
  return written == Written::no ? unusable : clean;
}

bool make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) {
    print_message(path + ": " + error.message());
  }
  return !error;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a != "-" && b != "-" && (a == b || std::filesystem::equivalent(a, b, ignored));
}

std::string ending_of(std::string_view path) {
  const std::string_view name = path.substr(path.find_last_of('/') + 1);
  const std::size_t point = name.find_last_of('.');
  std::string ending;
  for (const char c : point == std::string_view::npos ? std::string_view() : name.substr(point + 1)) {
    ending += to_lower(c);
  }
  return ending;
}

}  // namespace lexican::codict::cli
