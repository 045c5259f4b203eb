// SPDX-License-Identifier: Apache-2.0
// NMT slave. [301:7.2.8, 7.3.2]
#pragma once

#include "co_core.h"

namespace co::nmt {

// What may be communicated in a mode. [301:7.3.2.2.4]
[[nodiscard]] uint8_t allowed_in(CO_MODE mode);

void init(CO_NODE& node);

// False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Self-start by 1F80h.
void on_mode(CO_NODE& node);

// What 1029h:1 asks for.
void lose_communication(CO_NODE& node);

// See event::mode_for_switch().
[[nodiscard]] CO_MODE mode_for_switch(CO_NODE& node);

// From CO_INIT to Pre-operational, by the boot-up message.
void boot(CO_NODE& node);

}  // namespace co::nmt
