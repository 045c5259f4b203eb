// SPDX-License-Identifier: Apache-2.0
// TIME consumer and producer, a running clock, and the high-resolution time stamp. [301:7.2.6, 7.5.2.16]
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

// Advances tick, a clock value of the timer, by the whole seconds since then, and returns the remaining ticks. seconds:
// their number
uint32_t take_seconds(CO_NODE& node, uint32_t& tick, uint32_t& seconds);

// Converts ticks of less than a second to units of 10^-digits seconds. freq: ticks per second, up to 429 MHz
[[nodiscard]] uint32_t fraction_of_second(uint32_t ticks, uint32_t freq, unsigned digits);

#if USE_TIME_HIGH_RES
// The high-resolution time stamp. on_sync: a SYNC was received or is sent; on_synced: its PDOs were processed.
// stop_high_res: SYNC is no longer allowed.
void on_sync(CO_NODE& node, uint8_t counter);
void on_synced(CO_NODE& node);
void stop_high_res(CO_NODE& node);
inline constexpr Part part =
    Part().init(init).frames(on_frame).mode(on_mode).bus_off(flush).sync(on_sync).synced(on_synced);
#else
inline void stop_high_res(CO_NODE&) {}
inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).bus_off(flush);
#endif

}  // namespace co::time
