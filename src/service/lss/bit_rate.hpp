// SPDX-License-Identifier: Apache-2.0
// The switch of the bit rate, which masters and slaves do alike. [305]
#pragma once

#include "co_core.h"

namespace co::lss {

// The CAN controller takes another bit rate, in bit/s; its filters stay.
void take_bit_rate(CO_NODE& node, uint32_t rate);

}  // namespace co::lss
