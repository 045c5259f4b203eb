// SPDX-License-Identifier: Apache-2.0
// Switch of the bit rate, for LSS master and slave. [305]
#pragma once

#include "co_core.h"

namespace co::lss {

// Sets a new bit rate of the CAN controller, in bit/s; its filters are kept.
void take_bit_rate(CO_NODE& node, uint32_t rate);

}  // namespace co::lss
