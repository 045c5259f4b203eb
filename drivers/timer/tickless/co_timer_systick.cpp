// SPDX-License-Identifier: Apache-2.0
// SysTick counts from Reload to 0, and then from what Reload holds at that moment; a write to Value, whatever is
// written, makes it 0, and the next cycle reloads it. So a slice of any length can be followed by one of 2^24 cycles,
// in which no wrap gets lost.
#include "co_timer_systick.h"

#include "cycle_clock.hpp"

namespace {

constexpr uint32_t enabled = 1U << 0;
constexpr uint32_t interrupts = 1U << 1;
constexpr uint32_t cpu_clock = 1U << 2;
constexpr uint32_t pending = 1U << 26;      // of ICSR
constexpr uint32_t end_pending = 1U << 25;  // of ICSR

constexpr uint32_t most = 1U << 24;     // cycles of a slice
constexpr uint32_t least = 64;          // likewise: Reload is written again before such a slice ends
constexpr uint32_t longest_start = 64;  // cycles; a debugger, or an emulator that was held up, measures more

CO_SYSTICK& systick(void* ctx) { return *static_cast<CO_SYSTICK*>(ctx); }

bool has_wrapped(const CO_SYSTICK& t) { return (*t.Icsr & pending) != 0; }

struct Reading {
  bool wrapped_before;
  uint32_t value;
  bool wrapped_after;
};

// Cycles since the begin of the slice. Where the slice has ended between the readings, the value tells on which side; 0
// is the end itself.
uint32_t passed(const CO_SYSTICK& t, const Reading& reading) {
  const bool is_of_next = reading.wrapped_before || (reading.wrapped_after && reading.value > most / 2);
  return reading.value != 0 && is_of_next ? t.Slice + most - reading.value : t.Slice - reading.value;
}

uint32_t cycle(const CO_SYSTICK& t) {
  const bool before = has_wrapped(t);
  const uint32_t value = t.Regs->Value;
  return t.Begin + passed(t, {before, value, has_wrapped(t)});
}

// What happens in between is always the same: it is measured by init().
[[gnu::noinline]] uint32_t exchange(CO_SYSTICK_REGS& regs, uint32_t reload) {
  const uint32_t value = regs.Value;
  regs.Reload = reload;
  regs.Value = reload;
  return value;
}

[[gnu::noinline]] uint32_t measure(CO_SYSTICK_REGS& regs, uint32_t reload) {
  const uint32_t value = regs.Value;
  regs.Reload = reload;
  return value - regs.Value;
}

// The counter is 0 for a cycle before it is loaded: behind it, 0 is the end of the slice. In an emulator it is so for
// longer, as another thread loads it, which a CPU that reads registers without a pause holds up.
void await_begin(const CO_SYSTICK& t) {
  while (t.Regs->Value == 0) {
    for (volatile uint32_t pause = 0; pause != 1000; pause = pause + 1) {
    }
  }
}

void change(CO_SYSTICK& t) { __atomic_store_n(&t.Turn, t.Turn + 1, __ATOMIC_RELEASE); }

// A slice of 2^24 cycles begins; how much of the one before has passed is kept, and its interrupt is none any more.
void begin_longest(CO_SYSTICK& t) {
  const bool before = has_wrapped(t);
  const uint32_t value = exchange(*t.Regs, most - 1);
  t.Begin += passed(t, {before, value, has_wrapped(t)}) + t.Start;
  t.Slice = most;
  *t.Icsr = end_pending;
  await_begin(t);
}

// Whoever was held up here for longer than the slice (a CPU by a debugger, or by another program where it is emulated)
// finds that what followed it is as short: instead, one of 2^24 cycles begins now. The time in between is lost.
void end_slice(CO_SYSTICK& t) {
  t.Begin += t.Slice;
  t.Slice = 0;
  exchange(*t.Regs, most - 1);
  await_begin(t);
}

// Out of one that is far from its end: there is no interrupt that would have to be told from that of the new slice.
void begin_slice(CO_SYSTICK& t, uint32_t end) {
  const uint32_t left = end - (t.Begin + t.Slice - t.Regs->Value + t.Start);
  const uint32_t slice = left - least <= most - least ? left : least;
  t.Begin += t.Slice - exchange(*t.Regs, slice - 1) + t.Start;
  t.Slice = slice;
  await_begin(t);
  t.Regs->Reload = most - 1;
  if (has_wrapped(t)) {
    end_slice(t);
  }
}

void init(void* ctx, uint32_t freq) {
  CO_SYSTICK& t = systick(ctx);
  co::cycles::start(t.Clock, t.Hz, freq, 0);
  t.Regs->Reload = most - 1;
  t.Regs->Control = enabled | cpu_clock | interrupts;
  begin_longest(t);
  t.Begin = 0;
  const uint32_t start = measure(*t.Regs, most - 1);
  t.Start = start > longest_start ? longest_start : start;
  change(t);
}

// In the loop the interrupt, which changes what is read, may come in between.
uint32_t now(void* ctx) {
  const CO_SYSTICK& t = systick(ctx);
  for (;;) {
    const uint32_t turn = __atomic_load_n(&t.Turn, __ATOMIC_ACQUIRE);
    const uint32_t ticks = co::cycles::ticks(t.Clock, cycle(t));
    __atomic_signal_fence(__ATOMIC_ACQ_REL);
    if (__atomic_load_n(&t.Turn, __ATOMIC_ACQUIRE) == turn) {
      return ticks;
    }
  }
}

void alarm(void* ctx, uint32_t ticks) {
  CO_SYSTICK& t = systick(ctx);
  const uint32_t now = cycle(t);
  const uint32_t end = now + co::cycles::until(t.Clock, now, ticks, most);
  begin_longest(t);
  begin_slice(t, end);
  change(t);
}

}  // namespace

extern "C" void COSysTickInterrupt(CO_SYSTICK* timer) {
  timer->Begin += timer->Slice;
  timer->Slice = most;
  await_begin(*timer);
  change(*timer);
}

const CO_IF_TIMER_DRV_EX SysTickDriver = {init, now, alarm};
