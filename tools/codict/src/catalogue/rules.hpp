// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// The list of all rules.
#pragma once

#include <string_view>
#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::catalogue {

/// Returns all rules in the order of the reference, tools/codict/docs/rules.md.
const std::vector<const Rule*>& all_rules();

/// Returns the rule with an id; null if there is none.
const Rule* find_rule(std::string_view id);

/// Returns the ids of all rules, in the order of all_rules().
std::vector<std::string_view> all_ids();

/// Returns whether only the generator reports a rule (`gen-…`); checks never do.
bool is_of_generator(const Rule& rule);

/// Returns whether a rule is checked only on request. An unused suppression of such a rule is not reported.
bool is_optional(const Rule& rule);

}  // namespace lexican::codict::catalogue
