// SPDX-License-Identifier: Apache-2.0
// Conversion of cycles to ticks with 32-bit divisions; settle() has to be called at least once in 2^32 cycles.
#pragma once

#include "co_cycle_clock.h"

namespace co::cycles {

// Starts a clock at tick 0. freq: ticks per second; hz must be a multiple of it.
inline void start(CO_CYCLE_CLOCK& clock, uint32_t hz, uint32_t freq, uint32_t cycle) {
  const uint32_t per_tick = freq == 0 ? 0 : hz / freq;
  clock = {per_tick == 0 ? 1 : per_tick, cycle, 0};
}

inline uint32_t ticks(const CO_CYCLE_CLOCK& clock, uint32_t cycle) {
  return clock.Tick + (cycle - clock.Cycle) / clock.PerTick;
}

inline void settle(CO_CYCLE_CLOCK& clock, uint32_t cycle) {
  const uint32_t passed = (cycle - clock.Cycle) / clock.PerTick;
  clock.Tick += passed;
  clock.Cycle += passed * clock.PerTick;
}

// Updates the clock. Returns the cycles until a number of ticks has passed, at most `most`; 0 ticks: returns `most`.
inline uint32_t until(CO_CYCLE_CLOCK& clock, uint32_t cycle, uint32_t ticks, uint32_t most) {
  settle(clock, cycle);
  if (ticks == 0 || ticks > most / clock.PerTick) {
    return most;
  }
  return ticks * clock.PerTick - (cycle - clock.Cycle);
}

}  // namespace co::cycles
