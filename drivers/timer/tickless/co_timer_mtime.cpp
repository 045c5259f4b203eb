// SPDX-License-Identifier: Apache-2.0
#include "co_timer_mtime.h"

#include "cycle_clock.hpp"

namespace {

constexpr uint32_t longest_step = 1U << 31;  // longest step to the next interrupt, cycles

CO_MTIME& mtime(void* ctx) { return *static_cast<CO_MTIME*>(ctx); }

// Returns the low word, which wraps at 2^32 like CO_CYCLE_CLOCK.
uint32_t cycle(const CO_MTIME& t) { return t.Time[0]; }

// Counts a change of the clock. now() repeats its reading if the number has changed meanwhile.
void count_change(CO_MTIME& t) { __atomic_store_n(&t.Changes, t.Changes + 1, __ATOMIC_RELEASE); }

// Returns mtime. Repeats the reading if the low word has wrapped between the readings of the high word.
uint64_t time(const CO_MTIME& t) {
  uint32_t high = t.Time[1];
  for (;;) {
    const uint32_t low = t.Time[0];
    const uint32_t again = t.Time[1];
    if (again == high) {
      return uint64_t{high} << 32 | low;
    }
    high = again;
  }
}

// Writes the maximum to the high word first, so that no intermediate value causes an interrupt.
void set_compare(CO_MTIME& t, uint64_t at) {
  t.Compare[1] = UINT32_MAX;
  t.Compare[0] = static_cast<uint32_t>(at);
  t.Compare[1] = static_cast<uint32_t>(at >> 32);
}

void alarm(void* ctx, uint32_t ticks) {
  CO_MTIME& t = mtime(ctx);
  const uint64_t now = time(t);
  set_compare(t, now + co::cycle_clock::cycles_until(t.Clock, static_cast<uint32_t>(now), ticks, longest_step));
  count_change(t);
}

void init(void* ctx, uint32_t freq) {
  CO_MTIME& t = mtime(ctx);
  co::cycle_clock::start_clock(t.Clock, t.Hz, freq, cycle(t));
  alarm(ctx, 0);
}

// Repeats the reading if the interrupt has changed the clock meanwhile.
uint32_t now(void* ctx) {
  const CO_MTIME& t = mtime(ctx);
  for (;;) {
    const uint32_t changes = __atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE);
    const uint32_t ticks = co::cycle_clock::ticks_at(t.Clock, cycle(t));
    __atomic_signal_fence(__ATOMIC_ACQ_REL);
    if (__atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE) == changes) {
      return ticks;
    }
  }
}

}  // namespace

const CO_IF_TIMER_DRV_EX MtimeDriver = {init, now, alarm};
