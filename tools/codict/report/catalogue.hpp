// SPDX-License-Identifier: Apache-2.0
/// \file catalogue.hpp
/// All rules there are.
#pragma once

#include <string_view>
#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::report {

/// In the order of docs/codict.md.
const std::vector<const Rule*>& all_rules();

/// Null if there is none of this id.
const Rule* find_rule(std::string_view id);

/// Ids that may be meant by one that is none.
std::vector<std::string_view> similar_rules(std::string_view id);

/// Whether a rule is about what cannot be generated: no check ever breaks it.
bool is_of_generator(const Rule& rule);

}  // namespace lexican::codict::report
