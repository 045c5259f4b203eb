// SPDX-License-Identifier: Apache-2.0
#include "text/suppression.hpp"

#include <algorithm>
#include <cstddef>

namespace lexican::codict {

namespace {

constexpr std::size_t most_rules = 1000;  // limit per comment, more than the rules that exist

constexpr std::string_view separators = " \t\r\n,";

// Returns the next word of a text, and moves the beginning of `rest` behind it.
Span take_word(const Source& source, Span& rest) {
  const std::string_view text = source.slice(rest);
  const std::size_t begin = std::min(text.find_first_not_of(separators), text.size());
  const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
  const Span word{rest.begin + static_cast<std::uint32_t>(begin), rest.begin + static_cast<std::uint32_t>(end)};
  rest.begin = word.end;
  return word;
}

}  // namespace

std::vector<Suppression> suppressions_in(const Source& source, Span comment) {
  std::vector<Suppression> found;
  if (source.slice(take_word(source, comment)) != "codict:" || source.slice(take_word(source, comment)) != "ignore") {
    return found;
  }
  for (Span word = take_word(source, comment);
       !word.is_empty() && source.slice(word) != "--" && found.size() < most_rules; word = take_word(source, comment)) {
    found.push_back({word, std::nullopt});
  }
  return found;
}

}  // namespace lexican::codict
