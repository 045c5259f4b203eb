// SPDX-License-Identifier: Apache-2.0
// TIME consumer and producer, and a running clock. [301:7.2.6]
#pragma once

#include "base/part.hpp"

namespace co::time {

// Reads 1012h and applies it.
void init(CO_NODE& node);

// Processes a TIME message. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

void on_mode(CO_NODE& node);

// Withdraws a TIME message from the transmit queue when the controller leaves the bus: it must not be sent later.
void flush(CO_NODE& node);

// Sets and starts the clock. Returns the errors of COTimeSet().
[[nodiscard]] CO_ERR set_clock(CO_NODE& node, const CO_TIME_OF_DAY& time);

[[nodiscard]] bool is_set(const CO_NODE& node);

// Returns the time of the clock; 0 if it was not set yet.
[[nodiscard]] CO_TIME_OF_DAY read_clock(CO_NODE& node);

void stop_clock(CO_NODE& node);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).bus_off(flush);

}  // namespace co::time
