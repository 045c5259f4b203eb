// SPDX-License-Identifier: Apache-2.0
#include "catalogue/suppress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "catalogue/rules.hpp"
#include "text/similar.hpp"

namespace lexican::codict::catalogue {

namespace rules {

const Rule suppression_unknown{"suppression-unknown", Severity::warning, "comment that suppresses an unknown rule"};
const Rule suppression_unused{"suppression-unused", Severity::note, "comment that suppresses nothing"};

}  // namespace rules

const std::vector<const Rule*>& suppression_rules() {
  static const std::vector<const Rule*> all = {&rules::suppression_unknown, &rules::suppression_unused};
  return all;
}

namespace {

// The suppressions of one rule, and the places of its findings, sorted for binary search: a file may have many of both.
struct RuleSuppressions {
  std::vector<Suppression> suppressions;  // those with a scope, sorted by its beginning
  std::vector<std::uint32_t> reach;       // reach[n]: highest end of the scopes 0…n
  std::vector<std::uint32_t> places;
  std::vector<Span> nowhere;  // ids in comments that nothing follows

  bool covers(std::uint32_t place) const {
    const auto behind =
        std::upper_bound(suppressions.begin(), suppressions.end(), place,
                         [](std::uint32_t at, const Suppression& each) { return at < each.scope->begin; });
    return behind != suppressions.begin() &&
           reach[static_cast<std::size_t>(behind - suppressions.begin()) - 1] >= place;
  }
  bool is_used(const Suppression& suppression) const {
    const auto first = std::lower_bound(places.begin(), places.end(), suppression.scope->begin);
    return first != places.end() && *first <= suppression.scope->end;
  }
  void sort() {
    std::sort(suppressions.begin(), suppressions.end(),
              [](const Suppression& a, const Suppression& b) { return a.scope->begin < b.scope->begin; });
    std::sort(places.begin(), places.end());
    std::uint32_t last = 0;
    for (const Suppression& suppression : suppressions) {
      last = std::max(last, suppression.scope->end);
      reach.push_back(last);
    }
  }
};

using ByRule = std::map<const Rule*, RuleSuppressions>;

std::string hint_for(std::string_view id) {
  const std::vector<std::string_view> near = similar(id, all_ids());
  return near.empty() ? "codict explain lists all rules" : "did you mean " + std::string(near.front()) + "?";
}

void add_unused(const RuleSuppressions& wanted, Findings& findings) {
  for (const Suppression& suppression : wanted.suppressions) {
    if (!wanted.is_used(suppression)) {
      findings.add(rules::suppression_unused, suppression.rule, "comment suppresses nothing", "remove it");
    }
  }
  for (const Span place : wanted.nowhere) {
    findings.add(rules::suppression_unused, place, "comment at the end of the file suppresses nothing", "remove it");
  }
}

// Groups suppressions by rule, and reports those of unknown rules.
ByRule by_rule(const Source& source, const std::vector<Suppression>& suppressions, bool is_generator,
               Findings& findings) {
  constexpr std::size_t most_hints = 100;  // limits the time: each hint compares an id with all rules
  ByRule all;
  std::size_t unknown = 0;
  for (const Suppression& suppression : suppressions) {
    const std::string_view id = source.slice(suppression.rule);
    const Rule* const rule = find_rule(id);
    if (rule == nullptr && !is_generator) {
      findings.add(rules::suppression_unknown, suppression.rule, fmt::format("rule {} does not exist", in_quotes(id)),
                   ++unknown > most_hints ? std::string() : hint_for(id));
    } else if (rule != nullptr && suppression.scope) {
      all[rule].suppressions.push_back(suppression);
    } else if (rule != nullptr) {
      all[rule].nowhere.push_back(suppression.rule);
    }
  }
  return all;
}

}  // namespace

void suppress(const Source& source, const std::vector<Suppression>& suppressions, Origin origin, Findings& findings) {
  const bool is_generator = origin == Origin::generator;
  ByRule all = by_rule(source, suppressions, is_generator, findings);
  const auto may_go = [&](const Finding& finding) {
    return all.count(finding.rule) != 0 && !(is_generator && finding.severity == Severity::error);
  };
  for (const Finding& finding : findings.all()) {
    if (may_go(finding)) {
      all[finding.rule].places.push_back(finding.span.begin);
    }
  }
  for (auto& [rule, wanted] : all) {
    wanted.sort();
  }
  findings.remove_if(
      [&](const Finding& finding) { return may_go(finding) && all[finding.rule].covers(finding.span.begin); });
  for (const auto& [rule, wanted] : all) {
    if (is_of_generator(*rule) == is_generator && !is_optional(*rule)) {
      add_unused(wanted, findings);
    }
  }
  findings.sort();
}

}  // namespace lexican::codict::catalogue
