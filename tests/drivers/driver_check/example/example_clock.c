// SPDX-License-Identifier: Apache-2.0
#include "example_board.h"

static EXAMPLE_COUNTER* CounterOf(void* ctx) { return (EXAMPLE_COUNTER*)ctx; }

static void Init(void* ctx, uint32_t freq) {
  CounterOf(ctx)->Enable = 0;
  CounterOf(ctx)->Prescaler = EXAMPLE_CLOCK / freq;
}

static uint32_t Now(void* ctx) { return CounterOf(ctx)->Counter; }

// Sets the alarm. An alarm whose time had passed before the compare register was written is raised by software.
static void Alarm(void* ctx, uint32_t ticks) {
  EXAMPLE_COUNTER* const counter = CounterOf(ctx);
  counter->Enable = 0;
  counter->Match = 0;
  if (ticks == 0) {
    return;
  }
  const uint32_t start = counter->Counter;
  counter->Compare = start + ticks;
  counter->Enable = 1;
  if (counter->Counter - start >= ticks) {
    counter->Match = 1;
  }
}

const CO_IF_TIMER_DRV_EX ExampleClockDriver = {Init, Now, Alarm};

void ExampleClockInterrupt(EXAMPLE_COUNTER* counter) { counter->Match = 0; }
