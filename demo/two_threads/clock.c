// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L

#include "clock.h"

#include <time.h>

static uint64_t Nanoseconds(void) {
  struct timespec now;
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static void Init(void* ctx, uint32_t freq) {
  CO_UNUSED(ctx);
  CO_UNUSED(freq);
}

static uint32_t Now(void* ctx) {
  CO_UNUSED(ctx);
  return (uint32_t)(Nanoseconds() / (1000000000u / TICKS_PER_SECOND));
}

const CO_IF_TIMER_DRV_EX ClockDriver = {Init, Now, NULL};

uint32_t ClockMicroseconds(void) { return (uint32_t)(Nanoseconds() / 1000u); }

void ClockWait(uint32_t microseconds) {
  const struct timespec time = {(time_t)(microseconds / 1000000u), (long)(microseconds % 1000000u) * 1000};
  (void)nanosleep(&time, NULL);
}
