// SPDX-License-Identifier: Apache-2.0
// Counters of a node.
#pragma once

#include "co_core.h"

namespace co {

constexpr void count(uint32_t& counter) {
  if (counter != UINT32_MAX) {
    ++counter;
  }
}

}  // namespace co
