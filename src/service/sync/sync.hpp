// SPDX-License-Identifier: Apache-2.0
// SYNC consumer and producer. [301:7.2.5]
#pragma once

#include "base/part.hpp"

namespace co::sync {

// Assigns the timers to the real-time thread.
void take_over(CO_NODE& node, const CO_NODE_SPEC& spec);

// Reads 1005h, 1006h, 1007h and 1019h from the dictionary.
void init(CO_NODE& node);

// Starts the producer when SYNC is allowed; stops it and resets the counter when it is not. [301:7.2.5.1]
void on_mode(CO_NODE& node);

// Processes a SYNC. Returns false if it is malformed or not expected.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part().take_over(take_over).init(init).frames(on_frame).mode(on_mode);

}  // namespace co::sync
