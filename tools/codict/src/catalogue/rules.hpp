// SPDX-License-Identifier: Apache-2.0
/// \file rules.hpp
/// All rules there are.
#pragma once

#include <string_view>
#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::catalogue {

/// In the order of the reference, tools/codict/docs/rules.md.
const std::vector<const Rule*>& all_rules();

/// Null if there is none of this id.
const Rule* find_rule(std::string_view id);

/// In the same order.
std::vector<std::string_view> all_ids();

/// Whether a rule is about what cannot be generated: no check ever breaks it.
bool is_of_generator(const Rule& rule);

/// Whether a rule is looked for only where that is asked for: to have no effect is no fault of a suppression then.
bool is_optional(const Rule& rule);

}  // namespace lexican::codict::catalogue
