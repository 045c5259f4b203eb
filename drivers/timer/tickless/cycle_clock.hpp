// SPDX-License-Identifier: Apache-2.0
// Ticks from cycles, by divisions of 32 bits: the clock has to be settled before its cycles have run once around.
#pragma once

#include "co_cycle_clock.h"

namespace co::cycles {

// The driver's clock begins anew. freq: ticks per second, of which hz is a multiple.
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

// Settles the clock. Cycles from this one until a number of ticks is over, most at most; 0 ticks: no end.
inline uint32_t until(CO_CYCLE_CLOCK& clock, uint32_t cycle, uint32_t ticks, uint32_t most) {
  settle(clock, cycle);
  if (ticks == 0 || ticks > most / clock.PerTick) {
    return most;
  }
  return ticks * clock.PerTick - (cycle - clock.Cycle);
}

}  // namespace co::cycles
