// SPDX-License-Identifier: Apache-2.0
#include "program/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace lexican::program {

std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  bool is_valid = text.size() >= length && byte(0) < 0xF5 && (byte(0) < 0x80 || byte(0) >= 0xC2);
  for (std::size_t n = 1; n < length && is_valid; ++n) {
    is_valid = (byte(n) & 0xC0U) == 0x80;
  }
  return is_valid ? length : 0;
}

namespace {

/// Returns whether a character of UTF-8 controls a terminal, or changes the direction of writing.
bool is_control(std::string_view character) {
  const std::string_view two = character.substr(0, 2);
  const unsigned char last = static_cast<unsigned char>(character.back());
  return (character.size() == 1 && (last < 0x20 || last == 0x7F)) ||
         (character.size() == 2 && character.front() == '\xC2' && last < 0xA0) ||
         (character.size() == 3 && two == "\xE2\x80" && last >= 0xAA && last <= 0xAE) ||
         (character.size() == 3 && two == "\xE2\x81" && last >= 0xA6 && last <= 0xA9);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    const bool is_shown = length != 0 && (character == "\n" || !is_control(character));
    result += is_shown ? character : std::string_view("?");
    text.remove_prefix(character.size());
  }
  return result;
}

std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 512;
  std::string line(text.substr(0, longest));
  std::replace(line.begin(), line.end(), '\n', '?');
  return printable(line);
}

std::string state_text(std::uint8_t state) {
  switch (state) {
    case 0x00: return "boot-up";
    case 0x04: return "stopped";
    case 0x05: return "operational";
    case 0x7F: return "pre-operational";
    default: return fmt::format("unknown state {:02X}h", state);
  }
}

bool contains_ignoring_case(std::string_view text, std::string_view part) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [&](char a, char b) { return lower(a) == lower(b); }) != text.end();
}

}  // namespace lexican::program
