// SPDX-License-Identifier: Apache-2.0
// 1029h: reactions of the node to the loss of the network and to errors of the device. [301:7.5.2.32]
#pragma once

#include "base/part.hpp"

namespace co::error_behaviour {

// Executes the reaction of 1029h with this sub-index. Returns false, without effect, in CO_INIT and CO_INVALID.
bool react(CO_NODE& node, uint8_t sub);

// Implement the functions of base/events.hpp.
void lose_communication(CO_NODE& node);
[[nodiscard]] CO_MODE mode_for_switch(CO_NODE& node);

inline constexpr Part part = Part().bus_off(lose_communication);

}  // namespace co::error_behaviour
