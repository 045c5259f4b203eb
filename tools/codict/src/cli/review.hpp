// SPDX-License-Identifier: Apache-2.0
/// \file review.hpp
/// A description before and after a change.
#pragma once

#include "cli/command.hpp"

namespace lexican::codict::cli {

/// True if what would be written has no errors that were not there before. All that is new is shown, in its place of
/// the output.
bool review(Input& before, Input& after, const std::string& output);

}  // namespace lexican::codict::cli
