// SPDX-License-Identifier: Apache-2.0
// NMT slave. [301:7.2.8, 7.3.2]
#pragma once

#include "co_core.h"

namespace co::nmt {

// Number of the service in the table of node/services.cpp, for its route.
inline constexpr uint8_t service = 0;

// What may be communicated in a mode. [301:7.3.2.2.4]
[[nodiscard]] uint8_t allowed_in(CO_MODE mode);

void init(CO_NODE& node);

// False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// From CO_INIT to Pre-operational, by the boot-up message.
void boot(CO_NODE& node);

}  // namespace co::nmt
