// SPDX-License-Identifier: Apache-2.0
#include "cli/letters.hpp"

#include <algorithm>

namespace lexican::codict::cli {

namespace {

// Returns true for U+0080 to U+009F: in UTF-8, C2h and a byte below A0h.
bool is_c1(std::string_view letter) {
  return letter.size() > 1 && letter[0] == '\xC2' && static_cast<unsigned char>(letter[1]) < 0xA0;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }

}  // namespace

std::size_t letters(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_letter));
}

std::string visible(std::string_view text, std::string_view kept) {
  std::string result;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (is_c1(text.substr(n, 2))) {
      result += '?';
      ++n;
    } else {
      result += is_control(text[n]) && kept.find(text[n]) == std::string_view::npos ? '?' : text[n];
    }
  }
  return result;
}

}  // namespace lexican::codict::cli
