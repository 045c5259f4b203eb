// SPDX-License-Identifier: Apache-2.0
/// \file review.hpp
/// Comparison of the findings before and after a change.
#pragma once

#include "cli/command.hpp"

namespace lexican::codict::cli {

/// Shows all new findings, with their places in the output. Returns true if the changed description has no new errors.
bool review(Input& before, Input& after, const std::string& output);

}  // namespace lexican::codict::cli
