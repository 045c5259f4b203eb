// SPDX-License-Identifier: Apache-2.0
// Drivers that violate one requirement each, and the check that must detect it.
#pragma once

#include <vector>

#include "board.hpp"

namespace check {

struct Mutant {
  const char* name;
  const char* caught_by;
  std::function<void(Setting&)> spoil;
};

std::vector<Mutant> can_mutants();
std::vector<Mutant> timer_mutants();
std::vector<Mutant> nvm_mutants();

}  // namespace check
