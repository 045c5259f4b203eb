// SPDX-License-Identifier: Apache-2.0
// The drivers of this project and those of the simulated board, without faults.
#pragma once

#include <vector>

#include "board.hpp"

namespace check {

struct Case {
  const char* name;
  std::function<void(Setting&)> prepare;
  std::uint16_t skipped;  // number of checks that do not apply
};

// Cases for the drivers of each kind. Files are created in \a directory.
std::vector<Case> can_cases();
std::vector<Case> timer_cases();
std::vector<Case> nvm_cases(const std::string& directory);

}  // namespace check
