// SPDX-License-Identifier: Apache-2.0
// The timer driver of both nodes, and a wait function.
#ifndef DEMO_TWO_THREADS_CLOCK_H_
#define DEMO_TWO_THREADS_CLOCK_H_

#include "co_if_timer.h"

#define TICKS_PER_SECOND 10000u

extern const CO_IF_TIMER_DRV_EX ClockDriver;  // needs no context; has no alarm: every loop polls the timers

uint32_t ClockMicroseconds(void);
void ClockWait(uint32_t microseconds);

#endif
