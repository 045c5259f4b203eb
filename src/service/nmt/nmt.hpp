// SPDX-License-Identifier: Apache-2.0
// NMT slave. [301:7.2.8, 7.3.2]
#pragma once

#include "base/part.hpp"

namespace co::nmt {

// Returns the services that are allowed in a mode. [301:7.3.2.2.4]
[[nodiscard]] uint8_t allowed_in(CO_MODE mode);

void init(CO_NODE& node);

// Processes an NMT command. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Executes the self-start by 1F80h.
void on_mode(CO_NODE& node);

// Executes the reaction of 1029h with this sub-index. Returns false, without effect, in CO_INIT and CO_INVALID.
bool react(CO_NODE& node, uint8_t sub);

// Executes the reaction of 1029h:1.
void lose_communication(CO_NODE& node);

// Implements event::mode_for_switch().
[[nodiscard]] CO_MODE mode_for_switch(CO_NODE& node);

// Sends the boot-up message and requests Pre-operational, in CO_INIT.
void boot(CO_NODE& node);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).bus_off(lose_communication);

}  // namespace co::nmt
