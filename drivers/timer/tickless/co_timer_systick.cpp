// SPDX-License-Identifier: Apache-2.0
// SysTick counts down. One cycle after it has reached 0, it loads the current value of Reload. A write of any value to
// Value sets it to 0, so that the next cycle loads Reload. A slice is the time from such a load to the next 0.
//
// For an alarm, the driver begins a slice of the required length, and then sets Reload to 2^24 - 1 for the slice after
// it. So the interrupt at the end of the first slice may be late without losing a wrap.
#include "co_timer_systick.h"

#include "cycle_clock.hpp"

namespace {

constexpr uint32_t enabled = 1U << 0;
constexpr uint32_t interrupts = 1U << 1;
constexpr uint32_t cpu_clock = 1U << 2;
constexpr uint32_t pending = 1U << 26;      // bit of ICSR
constexpr uint32_t end_pending = 1U << 25;  // bit of ICSR

constexpr uint32_t longest_slice = 1U << 24;  // cycles
constexpr uint32_t shortest_slice = 64;       // cycles: Reload is written again before it ends
constexpr uint32_t longest_start_time = 64;   // cycles; a debugger or a delayed emulator would measure more

CO_SYSTICK& systick(void* ctx) { return *static_cast<CO_SYSTICK*>(ctx); }

bool has_wrapped(const CO_SYSTICK& t) { return (*t.Icsr & pending) != 0; }

struct Reading {
  bool wrapped_before;
  uint32_t value;
  bool wrapped_after;
};

// Returns the cycles since the beginning of the slice. If the slice has ended between the two readings of the flag, a
// value in the upper half belongs to the next slice, which has 2^24 cycles. The value 0 is the end of the slice.
uint32_t passed(const CO_SYSTICK& t, const Reading& reading) {
  const bool is_of_next = reading.wrapped_before || (reading.wrapped_after && reading.value > longest_slice / 2);
  return reading.value != 0 && is_of_next ? t.Slice + longest_slice - reading.value : t.Slice - reading.value;
}

// Returns the current cycle of the clock.
uint32_t cycle(const CO_SYSTICK& t) {
  const bool before = has_wrapped(t);
  const uint32_t value = t.Regs->Value;
  return t.Begin + passed(t, {before, value, has_wrapped(t)});
}

// Restarts SysTick. The cycles between reading and writing Value are constant: measure(), called by init(), measures
// them.
[[gnu::noinline]] uint32_t exchange(CO_SYSTICK_REGS& regs, uint32_t reload) {
  const uint32_t value = regs.Value;
  regs.Reload = reload;
  regs.Value = reload;
  return value;
}

// Returns the cycles that exchange() needs between its reading and its write of Value.
[[gnu::noinline]] uint32_t measure(CO_SYSTICK_REGS& regs, uint32_t reload) {
  const uint32_t value = regs.Value;
  regs.Reload = reload;
  return value - regs.Value;
}

// Waits until the counter is loaded. It is 0 for a cycle before that; later, 0 is the end of the slice. In an emulator
// it is 0 for longer, because another thread loads it, which a CPU that reads registers without a pause delays.
void await_begin(const CO_SYSTICK& t) {
  while (t.Regs->Value == 0) {
    for (volatile uint32_t pause = 0; pause != 1000; pause = pause + 1) {
    }
  }
}

// Counts a change of the clock. now() repeats its reading if the number has changed meanwhile.
void count_change(CO_SYSTICK& t) { __atomic_store_n(&t.Changes, t.Changes + 1, __ATOMIC_RELEASE); }

// Begins a slice of 2^24 cycles: adds the elapsed part of the previous slice to the clock and clears its interrupt.
void begin_longest(CO_SYSTICK& t) {
  const bool before = has_wrapped(t);
  const uint32_t value = exchange(*t.Regs, longest_slice - 1);
  t.Begin += passed(t, {before, value, has_wrapped(t)}) + t.Start;
  t.Slice = longest_slice;
  *t.Icsr = end_pending;
  await_begin(t);
}

// Called when the CPU was stopped here for longer than the slice (by a debugger, or by the host of an emulator). The
// slice after it would be as short, so one of 2^24 cycles begins now. The clock loses the time in between.
void end_slice(CO_SYSTICK& t) {
  t.Begin += t.Slice;
  t.Slice = 0;
  exchange(*t.Regs, longest_slice - 1);
  await_begin(t);
}

// Begins a slice that ends at a cycle. The current slice is far from its end, so no interrupt of it can be confused
// with that of the new slice.
void begin_slice(CO_SYSTICK& t, uint32_t end) {
  const uint32_t left = end - (t.Begin + t.Slice - t.Regs->Value + t.Start);
  const bool is_far = left - shortest_slice <= longest_slice - shortest_slice;  // false, too, if the end has passed
  const uint32_t slice = is_far ? left : shortest_slice;
  t.Begin += t.Slice - exchange(*t.Regs, slice - 1) + t.Start;
  t.Slice = slice;
  await_begin(t);
  t.Regs->Reload = longest_slice - 1;
  if (has_wrapped(t)) {
    end_slice(t);
  }
}

void init(void* ctx, uint32_t freq) {
  CO_SYSTICK& t = systick(ctx);
  co::cycle_clock::start_clock(t.Clock, t.Hz, freq, 0);
  t.Regs->Reload = longest_slice - 1;
  t.Regs->Control = enabled | cpu_clock | interrupts;
  begin_longest(t);
  t.Begin = 0;
  const uint32_t start = measure(*t.Regs, longest_slice - 1);
  t.Start = start > longest_start_time ? longest_start_time : start;
  count_change(t);
}

// Repeats the reading if the interrupt has changed the clock meanwhile.
uint32_t now(void* ctx) {
  const CO_SYSTICK& t = systick(ctx);
  for (;;) {
    const uint32_t changes = __atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE);
    const uint32_t ticks = co::cycle_clock::ticks_at(t.Clock, cycle(t));
    __atomic_signal_fence(__ATOMIC_ACQ_REL);
    if (__atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE) == changes) {
      return ticks;
    }
  }
}

void alarm(void* ctx, uint32_t ticks) {
  CO_SYSTICK& t = systick(ctx);
  const uint32_t now = cycle(t);
  const uint32_t end = now + co::cycle_clock::cycles_until(t.Clock, now, ticks, longest_slice);
  begin_longest(t);
  begin_slice(t, end);
  count_change(t);
}

}  // namespace

extern "C" void COSysTickInterrupt(CO_SYSTICK* timer) {
  timer->Begin += timer->Slice;
  timer->Slice = longest_slice;
  await_begin(*timer);
  count_change(*timer);
}

const CO_IF_TIMER_DRV_EX SysTickDriver = {init, now, alarm};
