// SPDX-License-Identifier: Apache-2.0
/// \file review.hpp
/// A description before and after a change.
#pragma once

#include "cli/command.hpp"

namespace lexican::codict::cli {

/// True if what would be written has no errors that were not there before. All that is new is shown.
bool review(Input& before, Input& after);

}  // namespace lexican::codict::cli
