// SPDX-License-Identifier: Apache-2.0
// Reception of frames.
#pragma once

#include "base/error.hpp"
#include "hal/port.hpp"

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
