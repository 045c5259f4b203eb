// SPDX-License-Identifier: Apache-2.0
// Last error of a node, and the object that it concerns.
#pragma once

#include "co_core.h"
#include "hal/port.hpp"

namespace co::error {

// Sets the node's error and the key of the object that it concerns (flags are ignored, 0: no object). CO_ERR_NONE
// changes nothing.
void report(CO_NODE& node, CO_ERR err, uint32_t key = 0);

}  // namespace co::error

// Counters of a node.

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

// Reception of frames.

namespace co::receive {

// Reads a frame from the driver. Returns its result; a fault is reported as the node's error.
[[nodiscard]] inline int16_t read(CO_NODE& node, CO_IF_FRM& frame) {
  const int16_t result = port::can_read(node, frame);
  if (result < 0) {
    error::report(node, CO_ERR_IF_CAN_READ);
  }
  return result;
}

}  // namespace co::receive
