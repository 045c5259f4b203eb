// SPDX-License-Identifier: Apache-2.0
/// \file costs.hpp
/// What gen and size say of a dictionary.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "gen/write.hpp"

namespace lexican::codict::cli {

/// A line for each part, and their sum.
std::string costs_text(const std::vector<gen::Cost>& costs);
Json costs_json(const std::vector<gen::Cost>& costs);

}  // namespace lexican::codict::cli
