// SPDX-License-Identifier: Apache-2.0
#include "program/command_words.hpp"

#include <algorithm>
#include <cctype>

namespace lexican::program {
namespace {

/// Returns a word as a shell needs it.
std::string quoted(const std::string& word) {
  constexpr std::string_view plain = "_.:/@=+,-";
  const bool is_plain = !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || plain.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) {
    return word;
  }
  if (word.find_first_of("\"$`\\!") == std::string::npos) {
    return '"' + word + '"';
  }
  std::string result = "'";
  for (const char c : word) {
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result + '\'';
}

}  // namespace

CommandWords words_of(const std::string& text) {
  std::vector<std::string> all;
  char quote = '\0';
  bool is_in_word = false;
  for (const char c : text) {
    if (quote != '\0' ? c == quote : (c == '"' || c == '\'')) {
      quote = quote != '\0' ? '\0' : c;
      if (!is_in_word) {
        all.emplace_back();
      }
      is_in_word = true;
    } else if (quote == '\0' && c == ' ') {
      is_in_word = false;
    } else {
      if (!is_in_word) {
        all.emplace_back();
      }
      is_in_word = true;
      all.back() += c;
    }
  }
  CommandWords result;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const bool is_type = all[n] == "--type";
    if (is_type && n + 1 < all.size()) {
      result.type = all[n + 1];
      result.options.insert(result.options.end(), {all[n], all[n + 1]});
      ++n;
    } else if (all[n] == "--verify" || all[n] == "--force") {
      result.verifies = result.verifies || all[n] == "--verify";
      result.is_forced = result.is_forced || all[n] == "--force";
      result.options.push_back(all[n]);
    } else if (is_type) {
      result.fault = "--type needs a type, such as u16";
    } else {
      result.words.push_back(all[n]);
    }
  }
  result.fault = quote != '\0' ? "a quote is not closed" : result.fault;
  result.fault = result.words.empty() && result.fault.empty() && !text.empty() ? "no word was typed" : result.fault;
  return result;
}

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) {
    result += (result.empty() ? "" : " ") + word;
  }
  return result;
}

std::string command_line(const std::vector<std::string>& words) {
  std::vector<std::string> result;
  std::transform(words.begin(), words.end(), std::back_inserter(result), quoted);
  return joined(result);
}

std::string utf8_of(std::uint32_t code) {
  const auto last = [code](unsigned shift) { return static_cast<char>(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) {
    return {static_cast<char>(code)};
  }
  if (code < 0x800) {
    return {static_cast<char>(0xC0U | code >> 6U), last(0)};
  }
  if (code < 0x10000) {
    return {static_cast<char>(0xE0U | code >> 12U), last(6), last(0)};
  }
  return {static_cast<char>(0xF0U | code >> 18U), last(12), last(6), last(0)};
}

void erase_last_character(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80) {
    text.pop_back();
  }
  if (!text.empty()) {
    text.pop_back();
  }
}

}  // namespace lexican::program
