// SPDX-License-Identifier: Apache-2.0
#include "eds/suppressions.hpp"

#include <algorithm>
#include <cstddef>

#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

// Returns the scope of a comment that precedes a line.
Span scope_of(const Document& document, std::uint32_t line) {
  const Source& source = document.source();
  const std::vector<Section>& sections = document.sections();
  const auto section = std::lower_bound(sections.begin(), sections.end(), line,
                                        [](const Section& each, std::uint32_t number) { return each.line < number; });
  if (section == sections.begin()) {
    return {0, source.size()};
  }
  const bool is_header = section != sections.end() && section->line == line;
  return {source.line(line).begin, source.line(is_header ? section->end - 1 : line).end};
}

// Returns the suppressions of a line; none if it is not a comment.
std::vector<Suppression> suppressions_in_line(const Source& source, Span line, std::string_view text) {
  if (text.substr(0, 1) != ";") {
    return {};
  }
  const auto begin = static_cast<std::uint32_t>(text.data() - source.bytes().data());
  return suppressions_in(source, {begin + 1, line.end});
}

}  // namespace

std::vector<Suppression> suppressions(const Document& document) {
  const Source& source = document.source();
  std::vector<Suppression> all;
  std::size_t waiting = 0;  // index of the first suppression whose scope is not yet set
  for (std::uint32_t number = 1; number <= source.lines(); ++number) {
    const Span line = source.line(number);
    const std::string_view text = trimmed(source.slice(line));
    const std::vector<Suppression> here = suppressions_in_line(source, line, text);
    all.insert(all.end(), here.begin(), here.end());
    const bool is_something = !text.empty() && text.front() != ';';
    for (; is_something && waiting < all.size(); ++waiting) {
      all[waiting].scope = scope_of(document, number);
    }
  }
  return all;
}

}  // namespace lexican::codict::eds
