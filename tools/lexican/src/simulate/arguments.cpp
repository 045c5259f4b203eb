// SPDX-License-Identifier: Apache-2.0
#include "simulate/arguments.hpp"

#include <charconv>
#include <cmath>

#include "text/number.hpp"

namespace lexican::simulate {

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool is_quoted = false;
  bool has_word = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
      has_word = true;
    } else if (!is_quoted && (c == ' ' || c == '\t' || c == '\r')) {
      if (has_word) {
        words.push_back(word);
      }
      word.clear();
      has_word = false;
    } else {
      word += c;
      has_word = true;
    }
  }
  if (has_word) {
    words.push_back(word);
  }
  return words;
}

std::optional<double> real_in(std::string_view text, std::string_view& unit) {
  double number = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  unit = std::string_view(next, static_cast<std::size_t>(text.data() + text.size() - next));
  return error == std::errc() && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<Micros> time_in(std::string_view text) {
  std::string_view unit;
  const std::optional<double> number = real_in(text, unit);
  const double factor = unit == "ms" ? 1e3 : unit == "s" ? 1e6 : unit == "min" ? 60e6 : 0;
  const bool is_time = number && factor != 0 && *number >= 0 && *number * factor < 1e15;
  return is_time ? std::optional(static_cast<Micros>(*number * factor)) : std::nullopt;
}

std::optional<double> part_in(std::string_view text) {
  std::string_view unit;
  const std::optional<double> number = real_in(text, unit);
  return number && unit == "%" && *number >= 0 && *number <= 100 ? std::optional(*number / 100) : std::nullopt;
}

std::optional<std::uint32_t> hex_in(std::string_view text) {
  std::uint64_t number = 0;
  if (text.substr(0, 2) == "0x") {
    text.remove_prefix(2);
  } else if (!text.empty() && text.back() == 'h') {
    text.remove_suffix(1);
  }
  return codict::parse_hex(text, number) && number <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(number))
                                                                 : std::nullopt;
}

}  // namespace lexican::simulate
