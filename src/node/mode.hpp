// SPDX-License-Identifier: Apache-2.0
// The NMT state machine. [301:7.2.8, 7.3.2]
#pragma once

#include "base/part.hpp"

namespace co::nmt {

void init(CO_NODE& node);

// Processes an NMT command. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Executes the self-start by 1F80h.
void on_mode(CO_NODE& node);

// Runs a deferred reset. pending: bits of event::Pending
void run_reset(CO_NODE& node, uint8_t pending);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode);

}  // namespace co::nmt
