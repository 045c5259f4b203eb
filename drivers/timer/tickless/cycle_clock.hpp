// SPDX-License-Identifier: Apache-2.0
/// \file cycle_clock.hpp
/// Conversion of cycles to ticks with 32-bit divisions, for drivers with a CO_CYCLE_CLOCK. update_clock() or
/// cycles_until() has to be called at least once in 2^32 cycles.
#pragma once

#include "co_cycle_clock.h"

/// Internals of the timer drivers that count cycles. Not for applications.
namespace co::cycle_clock {

/// Starts a clock at tick 0. \a hz: cycles per second, a multiple of \a freq; \a freq: ticks per second, 0: a tick is a
/// cycle; \a cycle: the present cycle.
inline void start_clock(CO_CYCLE_CLOCK& clock, uint32_t hz, uint32_t freq, uint32_t cycle) {
  const uint32_t per_tick = freq == 0 ? 0 : hz / freq;
  clock = {per_tick == 0 ? 1 : per_tick, cycle, 0};
}

/// Returns the ticks since the start. \a cycle: the present cycle.
inline uint32_t ticks_at(const CO_CYCLE_CLOCK& clock, uint32_t cycle) {
  return clock.Tick + (cycle - clock.Cycle) / clock.PerTick;
}

/// Adds the complete ticks since the last update to the clock. \a cycle: the present cycle.
inline void update_clock(CO_CYCLE_CLOCK& clock, uint32_t cycle) {
  const uint32_t passed = (cycle - clock.Cycle) / clock.PerTick;
  clock.Tick += passed;
  clock.Cycle += passed * clock.PerTick;
}

/// Updates the clock like update_clock(). Returns the cycles until \a ticks ticks have passed, at most \a most; 0
/// ticks: returns \a most.
inline uint32_t cycles_until(CO_CYCLE_CLOCK& clock, uint32_t cycle, uint32_t ticks, uint32_t most) {
  update_clock(clock, cycle);
  if (ticks == 0 || ticks > most / clock.PerTick) {
    return most;
  }
  return ticks * clock.PerTick - (cycle - clock.Cycle);
}

}  // namespace co::cycle_clock
