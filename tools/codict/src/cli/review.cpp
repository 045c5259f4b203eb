// SPDX-License-Identifier: Apache-2.0
#include "cli/review.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/render.hpp"

namespace lexican::codict::cli {

namespace {

// Returns the first finding of each kind that occurs more often than before.
std::vector<Finding> added(const Findings& before, const Findings& after) {
  std::vector<Finding> result;
  const std::vector<FoldedFindings> old = fold(before.all());
  for (const FoldedFindings& now : fold(after.all())) {
    const auto same = std::find_if(old.begin(), old.end(), [&now](const FoldedFindings& candidate) {
      return candidate.first->rule == now.first->rule && candidate.kind == now.kind;
    });
    if (same == old.end() || same->more < now.more) {
      result.push_back(*now.first);
    }
  }
  return result;
}

}  // namespace

bool review(Input& before, Input& after, const std::string& output) {
  check_all(before);
  check_all(after);
  const std::vector<Finding> fresh = added(before.findings, after.findings);
  fmt::print(stderr, "{}",
             render(Source(output == "-" ? "<stdout>" : output, std::string(after.source().bytes())), after.encoding(),
                    fold(fresh), false));
  return std::none_of(fresh.begin(), fresh.end(),
                      [](const Finding& finding) { return finding.rule->severity == Severity::error; });
}

}  // namespace lexican::codict::cli
