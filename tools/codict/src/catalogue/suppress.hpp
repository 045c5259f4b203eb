// SPDX-License-Identifier: Apache-2.0
/// \file suppress.hpp
/// Comments of a description that ask for rules to be passed over, and what they ask for.
#pragma once

#include <vector>

#include "text/finding.hpp"
#include "text/source.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::catalogue {

/// Who has made the findings: each has rules of its own.
enum class Origin : unsigned char { checks, generator };

/// Takes away what is not to be told, and adds what is off in the suppressions themselves. What keeps the generator
/// from writing anything is always told.
void suppress(const Source& source, const std::vector<Suppression>& suppressions, Origin origin, Findings& findings);

namespace rules {
extern const Rule suppression_unknown;
extern const Rule suppression_unused;
}  // namespace rules

const std::vector<const Rule*>& suppression_rules();

}  // namespace lexican::codict::catalogue
