// SPDX-License-Identifier: Apache-2.0
#include "co_timer_nrf51.h"

namespace {

static_assert(offsetof(CO_NRF51_TIMER_REGS, Capture) == 0x040 && offsetof(CO_NRF51_TIMER_REGS, Compared) == 0x140);
static_assert(offsetof(CO_NRF51_TIMER_REGS, InterruptsOn) == 0x304 && offsetof(CO_NRF51_TIMER_REGS, Mode) == 0x504);
static_assert(offsetof(CO_NRF51_TIMER_REGS, Prescaler) == 0x510 && offsetof(CO_NRF51_TIMER_REGS, Compare) == 0x540);

constexpr uint32_t clock_hz = 16000000;
constexpr uint32_t highest_prescaler = 9;
constexpr uint32_t bits_32 = 3;

// Compare registers for the current time and for the alarm.
constexpr unsigned time_register = 0;
constexpr unsigned alarm_register = 1;
constexpr uint32_t alarm_interrupt = 1U << (16 + alarm_register);

// Ticks that a compare value must be ahead of the clock when it is written; an upper bound of the time of writing.
constexpr uint32_t lead = 4;

CO_NRF51_TIMER_REGS& registers(void* ctx) { return *static_cast<CO_NRF51_TIMER*>(ctx)->Regs; }

// Captures and returns the current time. If the interrupt calls this function between the two lines, the result is the
// time that it has captured, which is newer.
uint32_t capture(CO_NRF51_TIMER_REGS& regs) {
  regs.Capture[time_register] = 1;
  return regs.Compare[time_register];
}

void init(void* ctx, uint32_t freq) {
  CO_NRF51_TIMER_REGS& regs = registers(ctx);
  uint32_t prescaler = 0;
  while (prescaler < highest_prescaler && clock_hz >> prescaler > freq) {
    ++prescaler;
  }
  regs.Stop = 1;
  regs.InterruptsOff = UINT32_MAX;
  regs.Mode = 0;
  regs.BitMode = bits_32;
  regs.Prescaler = prescaler;
  regs.Clear = 1;
  regs.Start = 1;
}

uint32_t now(void* ctx) { return capture(registers(ctx)); }

// Sets the compare value. If it has already passed when it is written, it would match one wrap of the clock later:
// repeats the write with a later value until it is in the future.
void alarm(void* ctx, uint32_t ticks) {
  CO_NRF51_TIMER_REGS& regs = registers(ctx);
  regs.InterruptsOff = alarm_interrupt;
  regs.Compared[alarm_register] = 0;
  if (ticks == 0) {
    return;
  }
  const uint32_t begin = capture(regs);
  uint32_t wait = ticks < lead ? lead : ticks;
  regs.Compare[alarm_register] = begin + wait;
  for (uint32_t passed = capture(regs) - begin; passed >= wait; passed = capture(regs) - begin) {
    wait = passed + lead;
    regs.Compare[alarm_register] = begin + wait;
  }
  regs.InterruptsOn = alarm_interrupt;
}

}  // namespace

const CO_IF_TIMER_DRV_EX Nrf51TimerDriver = {init, now, alarm};
