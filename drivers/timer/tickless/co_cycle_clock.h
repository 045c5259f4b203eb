// SPDX-License-Identifier: Apache-2.0
/// \file co_cycle_clock.h
/// What the timers that count cycles of a CPU have in common: ticks that are some cycles long.
#ifndef CO_CYCLE_CLOCK_H_
#define CO_CYCLE_CLOCK_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A clock of ticks, kept by a driver; both counters wrap at 2^32.
typedef struct CO_CYCLE_CLOCK_T {
  uint32_t PerTick;  ///< cycles
  uint32_t Cycle;    ///< at which Tick has begun
  uint32_t Tick;
} CO_CYCLE_CLOCK;

#ifdef __cplusplus
}
#endif

#endif
