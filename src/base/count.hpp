// SPDX-License-Identifier: Apache-2.0
// Counters of a node.
#pragma once

#include "co_core.h"

namespace co {

// Increments a counter, which stays at its highest value.
#if USE_FAST_PATHS
inline void count(uint32_t& counter) {
  const uint32_t next = counter + 1;
  if (next != 0) {
    counter = next;
  }
}
#else
void count(uint32_t& counter);
#endif

}  // namespace co
