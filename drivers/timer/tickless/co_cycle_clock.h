// SPDX-License-Identifier: Apache-2.0
/// \file co_cycle_clock.h
/// Tick clock shared by the timer drivers that count cycles of a CPU; a tick is a number of cycles.
#ifndef CO_CYCLE_CLOCK_H_
#define CO_CYCLE_CLOCK_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A tick clock, owned and updated by a driver; both counters wrap at 2^32.
typedef struct CO_CYCLE_CLOCK_T {
  uint32_t PerTick;  ///< cycles in a tick
  uint32_t Cycle;    ///< cycle at which Tick has begun
  uint32_t Tick;     ///< ticks since the start, at the last update
} CO_CYCLE_CLOCK;

#ifdef __cplusplus
}
#endif

#endif
