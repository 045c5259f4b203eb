// SPDX-License-Identifier: Apache-2.0
/// \file words.hpp
/// Splits texts.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace test {

/// Returns the parts of a text between separators. A separator at the end adds no empty part.
inline std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

/// Returns the words between spaces.
inline std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words = parts_of(text, ' ');
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

}  // namespace test
