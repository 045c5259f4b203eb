// SPDX-License-Identifier: Apache-2.0
/// \file suppressions.hpp
/// Comments of an EDS or DCF that suppress rules.
#pragma once

#include <vector>

#include "eds/document.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::eds {

/// Returns the suppressions of a document. Above the first section, a comment applies to the whole file; above another
/// section, to that section; else to the next line.
std::vector<Suppression> suppressions(const Document& document);

}  // namespace lexican::codict::eds
