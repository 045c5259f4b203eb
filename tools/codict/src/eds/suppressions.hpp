// SPDX-License-Identifier: Apache-2.0
/// \file suppressions.hpp
/// What comments of an EDS or DCF ask to be passed over.
#pragma once

#include <vector>

#include "eds/document.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::eds {

/// Above the first section, for the whole file; above a section, for that section; else for the next line.
std::vector<Suppression> suppressions(const Document& document);

}  // namespace lexican::codict::eds
