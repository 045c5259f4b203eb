// SPDX-License-Identifier: Apache-2.0
// The counter runs from 0 to its last value and sets UIF when it wraps. CC1IF is set when it reaches Ccr1. Flags are
// cleared by writing 0 and not changed by writing 1, so that a flag that is set meanwhile is not lost.
#include "co_timer_stm32_tim.h"

#include "../tickless/cycle_clock.hpp"

#ifdef LEXICAN_REGISTER_MODEL
extern "C" uint32_t lexican_model_read(uintptr_t address);
extern "C" void lexican_model_write(uintptr_t address, uint32_t value);
#endif

namespace {

// Accesses to registers; a test replaces them by a model.
#ifdef LEXICAN_REGISTER_MODEL
uint32_t load(const volatile uint32_t& reg) { return lexican_model_read(reinterpret_cast<uintptr_t>(&reg)); }
void store(volatile uint32_t& reg, uint32_t value) { lexican_model_write(reinterpret_cast<uintptr_t>(&reg), value); }
#else
uint32_t load(const volatile uint32_t& reg) { return reg; }
void store(volatile uint32_t& reg, uint32_t value) { reg = value; }
#endif

static_assert(offsetof(CO_STM32_TIM_REGS, Dier) == 0x0C && offsetof(CO_STM32_TIM_REGS, Ccmr1) == 0x18);
static_assert(offsetof(CO_STM32_TIM_REGS, Cnt) == 0x24 && offsetof(CO_STM32_TIM_REGS, Ccr1) == 0x34);

constexpr uint32_t counter_enabled = 1U << 0;     // CR1.CEN
constexpr uint32_t only_overflow = 1U << 2;       // CR1.URS: UIF is not set by EGR.UG
constexpr uint32_t wrapped = 1U << 0;             // SR.UIF, DIER.UIE, EGR.UG
constexpr uint32_t matched = 1U << 1;             // SR.CC1IF, DIER.CC1IE, EGR.CC1G
constexpr uint32_t highest_prescaler = 1U << 16;  // divides the clock
constexpr uint32_t narrow = 16;                   // bits

CO_STM32_TIM& timer_of(void* ctx) { return *static_cast<CO_STM32_TIM*>(ctx); }

bool is_narrow(const CO_STM32_TIM& t) { return t.Bits == narrow; }
uint32_t last_count(const CO_STM32_TIM& t) { return is_narrow(t) ? UINT16_MAX : UINT32_MAX; }

// Returns half of the range, in counts: the longest time for which the compare value is set.
uint32_t half_range(const CO_STM32_TIM& t) { return last_count(t) / 2 + 1; }

void clear(const CO_STM32_TIM& t, uint32_t flag) { store(t.Regs->Sr, ~flag); }

// Increments the number of changes. now() reads the clock again if the number has changed meanwhile.
void count_change(CO_STM32_TIM& t) { __atomic_store_n(&t.Changes, t.Changes + 1, __ATOMIC_RELEASE); }

// Returns the present count, across the wraps of the counter. A wrap whose interrupt has not run yet is added.
uint32_t count(const CO_STM32_TIM& t) {
  const bool before = (load(t.Regs->Sr) & wrapped) != 0;
  const uint32_t value = load(t.Regs->Cnt);
  const bool after = (load(t.Regs->Sr) & wrapped) != 0;
  const bool has_wrapped = before || (after && value < half_range(t));
  return t.Begin + (has_wrapped ? last_count(t) + 1 : 0) + value;
}

// Sets the compare value to wait counts after begin. Requests the interrupt if the counter has passed it meanwhile.
void match(const CO_STM32_TIM& t, uint32_t begin, uint32_t wait) {
  store(t.Regs->Ccr1, (begin + wait) & last_count(t));
  clear(t, matched);
  if (count(t) - begin >= wait) {
    store(t.Regs->Egr, matched);
  }
}

// Returns the divisor of the prescaler: the largest one that divides the input cycles of a tick.
uint32_t prescaler(uint32_t hz, uint32_t freq) {
  const uint32_t ratio = freq == 0 || hz < freq ? 1 : hz / freq;
  uint32_t counts = (ratio + highest_prescaler - 1) / highest_prescaler;  // counts of a tick
  while (ratio % counts != 0) {
    ++counts;
  }
  return ratio / counts;
}

void alarm(void* ctx, uint32_t ticks) {
  CO_STM32_TIM& t = timer_of(ctx);
  const uint32_t begin = count(t);
  match(t, begin, co::cycle_clock::cycles_until(t.Clock, begin, ticks, half_range(t)));
  count_change(t);
}

void init(void* ctx, uint32_t freq) {
  CO_STM32_TIM& t = timer_of(ctx);
  CO_STM32_TIM_REGS& regs = *t.Regs;
  const uint32_t divisor = prescaler(t.Hz, freq);
  store(regs.Cr1, only_overflow);
  store(regs.Dier, 0);
  store(regs.Ccmr1, 0);  // output compare without effect on a pin
  store(regs.Psc, divisor - 1);
  store(regs.Arr, last_count(t));
  store(regs.Egr, wrapped);  // loads the prescaler, and sets the counter to 0
  store(regs.Sr, 0);
  t.Begin = 0;
  co::cycle_clock::start_clock(t.Clock, t.Hz / divisor, freq, 0);
  store(regs.Cr1, only_overflow | counter_enabled);
  alarm(ctx, 0);
  store(regs.Dier, is_narrow(t) ? matched | wrapped : matched);
}

// Reads the clock, again if the interrupt has changed it meanwhile.
uint32_t now(void* ctx) {
  const CO_STM32_TIM& t = timer_of(ctx);
  for (;;) {
    const uint32_t changes = __atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE);
    const uint32_t ticks = co::cycle_clock::ticks_at(t.Clock, count(t));
    __atomic_signal_fence(__ATOMIC_ACQ_REL);
    if (__atomic_load_n(&t.Changes, __ATOMIC_ACQUIRE) == changes) {
      return ticks;
    }
  }
}

}  // namespace

extern "C" void COStm32TimInterrupt(CO_STM32_TIM* timer) {
  CO_STM32_TIM& t = *timer;
  const uint32_t flags = load(t.Regs->Sr);
  if ((flags & wrapped) != 0) {
    clear(t, wrapped);
    t.Begin += last_count(t) + 1;
    count_change(t);
  }
  if ((flags & matched) != 0) {
    alarm(timer, 0);  // COTmrService() sets the next alarm of the node
  }
}

const CO_IF_TIMER_DRV_EX Stm32TimDriver = {init, now, alarm};
