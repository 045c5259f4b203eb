// SPDX-License-Identifier: Apache-2.0
// The drivers of this project, and those of the simulated board, as they are.
#pragma once

#include <vector>

#include "board.hpp"

namespace check {

struct Case {
  const char* name;
  std::function<void(Setting&)> prepare;
  std::uint16_t skipped;  // checks that do not apply
};

// Files are made in directory.
std::vector<Case> can_cases();
std::vector<Case> timer_cases();
std::vector<Case> nvm_cases(const std::string& directory);

}  // namespace check
