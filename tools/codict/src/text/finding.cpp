// SPDX-License-Identifier: Apache-2.0
#include "text/finding.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace lexican::codict {

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: break;
  }
  return "error";
}

std::size_t Findings::count(const Rule& rule) const {
  return static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [&rule](const Finding& finding) { return finding.rule == &rule; }));
}

std::size_t Findings::count(Severity severity) const {
  return static_cast<std::size_t>(std::count_if(
      all_.begin(), all_.end(), [severity](const Finding& finding) { return finding.rule->severity == severity; }));
}

void Findings::sort() {
  std::stable_sort(all_.begin(), all_.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.span.begin, a.span.end) < std::tie(b.span.begin, b.span.end);
  });
}

std::vector<Folded> fold(const std::vector<Finding>& findings) {
  std::vector<Folded> folded;
  std::map<std::pair<const Rule*, std::string_view>, std::size_t> places;
  for (const Finding& finding : findings) {
    const auto [place, is_new] = places.try_emplace({finding.rule, finding.text}, folded.size());
    if (is_new) {
      folded.push_back({&finding, 0});
    } else {
      ++folded[place->second].more;
    }
  }
  return folded;
}

}  // namespace lexican::codict
