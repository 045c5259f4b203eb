// SPDX-License-Identifier: Apache-2.0
#include "catalogue/suppress.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "catalogue/rules.hpp"
#include "text/similar.hpp"

namespace lexican::codict::catalogue {

namespace rules {

const Rule suppression_unknown{"suppression-unknown", Severity::warning,
                               "A comment that suppresses a rule names one that there is."};
const Rule suppression_unused{"suppression-unused", Severity::note, "A comment that suppresses a rule has an effect."};

}  // namespace rules

const std::vector<const Rule*>& suppression_rules() {
  static const std::vector<const Rule*> all = {&rules::suppression_unknown, &rules::suppression_unused};
  return all;
}

namespace {

// Each finding is compared with all of its rule: a file must not make that take long.
constexpr std::size_t most_wanted = 10000;

struct Known {
  Suppression suppression;
  bool is_used = false;
};

// By rule.
using Wanted = std::multimap<const Rule*, Known>;

bool covers(const Suppression& suppression, Span place) {
  return suppression.scope && place.begin >= suppression.scope->begin && place.begin <= suppression.scope->end;
}

// All that cover the finding have an effect.
bool is_suppressed(const Finding& finding, Wanted& wanted) {
  bool is_covered = false;
  const auto [first, last] = wanted.equal_range(finding.rule);
  for (auto each = first; each != last; ++each) {
    if (covers(each->second.suppression, finding.span)) {
      each->second.is_used = true;
      is_covered = true;
    }
  }
  return is_covered;
}

std::string hint_for(std::string_view id) {
  const std::vector<std::string_view> near = similar(id, all_ids());
  return near.empty() ? "codict explain names all rules" : std::string(near.front());
}

}  // namespace

void suppress(const Source& source, const std::vector<Suppression>& suppressions, Origin origin, Findings& findings) {
  const bool is_generator = origin == Origin::generator;
  Wanted wanted;
  for (const Suppression& suppression : suppressions) {
    if (wanted.size() == most_wanted) {
      findings.add(rules::suppression_unused, suppression.rule, "too many of these comments: others are not looked at");
      break;
    }
    const std::string_view id = source.slice(suppression.rule);
    if (const Rule* const rule = find_rule(id)) {
      wanted.emplace(rule, Known{suppression});
    } else if (!is_generator) {
      findings.add(rules::suppression_unknown, suppression.rule, "there is no such rule", hint_for(id));
    }
  }
  findings.remove_if([&](const Finding& finding) {
    return !(is_generator && finding.severity == Severity::error) && is_suppressed(finding, wanted);
  });
  for (const auto& [rule, known] : wanted) {
    if (!known.is_used && is_of_generator(*rule) == is_generator) {
      findings.add(rules::suppression_unused, known.suppression.rule,
                   known.suppression.scope ? "nothing to suppress where this comment is for"
                                           : "nothing follows that this comment could be for");
    }
  }
  findings.sort();
}

}  // namespace lexican::codict::catalogue
