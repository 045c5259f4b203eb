// SPDX-License-Identifier: Apache-2.0
#include "eds/suppressions.hpp"

#include <algorithm>
#include <cstddef>

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

}  // namespace

std::vector<Suppression> suppressions(const Document& document) {
  const Source& source = document.source();
  std::vector<Suppression> all;
  std::size_t waiting = 0;  // index of the first suppression whose scope is not yet set
  for (std::uint32_t number = 1; number <= source.lines(); ++number) {
    const Span line = document.content(number);
    if (line.is_empty()) {
      continue;
    }
    if (source.slice(line).front() == ';') {
      const std::vector<Suppression> here = suppressions_in(source, {line.begin + 1, line.end});
      all.insert(all.end(), here.begin(), here.end());
      continue;
    }
    for (; waiting < all.size(); ++waiting) {
      all[waiting].scope = scope_of(document, number);
    }
  }
  return all;
}

}  // namespace lexican::codict::eds
