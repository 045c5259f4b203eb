// SPDX-License-Identifier: Apache-2.0
/// \file stores.hpp
/// Option --store GROUP=SUB: sub-index of 1010h for a storage group.
#pragma once

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "gen/plan.hpp"

namespace lexican::codict::cli {

void add_stores(Arguments& command, std::vector<std::string>& stores);

/// Parses the values of --store. Returns false after a message if one of them is malformed.
bool parse_stores(const std::vector<std::string>& stores, gen::Options& options);

}  // namespace lexican::codict::cli
