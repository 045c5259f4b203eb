// SPDX-License-Identifier: Apache-2.0
/// \file suppress.hpp
/// Suppression of findings by comments of a description.
#pragma once

#include <vector>

#include "text/finding.hpp"
#include "text/source.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::catalogue {

/// Origin of the findings: checks and generator report different rules.
enum class Origin : unsigned char { checks, generator };

/// Removes suppressed findings, and adds findings about the suppressions themselves. Errors of the generator are never
/// suppressed, because they prevent its output.
void suppress(const Source& source, const std::vector<Suppression>& suppressions, Origin origin, Findings& findings);

namespace rules {
extern const Rule suppression_unknown;
extern const Rule suppression_unused;
}  // namespace rules

const std::vector<const Rule*>& suppression_rules();

}  // namespace lexican::codict::catalogue
