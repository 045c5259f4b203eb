// SPDX-License-Identifier: Apache-2.0
/// \file costs.hpp
/// RAM and flash of a dictionary, as gen and size print them.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "gen/write.hpp"

namespace lexican::codict::cli {

/// Returns a table with a line for each part, and the sum.
std::string costs_text(const std::vector<gen::Cost>& costs);
Json costs_json(const std::vector<gen::Cost>& costs);

}  // namespace lexican::codict::cli
