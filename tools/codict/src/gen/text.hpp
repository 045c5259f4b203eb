// SPDX-License-Identifier: Apache-2.0
/// \file text.hpp
/// Buffer for lines of generated source.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace lexican::codict::gen {

class Lines {
 public:
  Lines() = default;
  /// Reserves memory, so that a large text need not be copied as it grows.
  explicit Lines(std::size_t expected) { text_.reserve(expected); }

  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  void blank() { text_ += '\n'; }
  void raw(std::string_view text) { text_ += text; }
  std::string take_text() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace lexican::codict::gen
