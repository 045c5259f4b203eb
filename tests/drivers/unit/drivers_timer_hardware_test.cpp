// SPDX-License-Identifier: Apache-2.0
// Timers of microcontrollers, on registers simulated by the test: expiries are never early and never lost, also when
// counters wrap.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "co_timer_mtime.h"
#include "co_timer_nrf51.h"
#include "co_timer_systick.h"
#include "support/stride.hpp"

namespace {

constexpr std::uint32_t cycles_per_tick = 25;
constexpr std::uint32_t mega = 1000000;
constexpr std::uint32_t pending = 1u << 26;
constexpr std::uint32_t longest_slice = 1u << 24;

/// SysTick of a CPU at 25 MHz, with ticks of 1 us.
struct SysTick {
  SysTick() {
    SysTickDriver.Init(&timer, mega);
    load();
  }

  /// Checks that the driver has started a slice and has waited for the cycle in which the counter is loaded.
  void load() {
    REQUIRE(registers.Value == timer.Slice - 1);
    ++total;
  }
  /// Lets the counter run for some cycles of the CPU.
  void run(std::uint32_t cycles) {
    total += cycles;
    while (cycles != 0) {
      if (registers.Value == 0) {
        registers.Value = registers.Reload;
        --cycles;
        continue;
      }
      const std::uint32_t left = registers.Value;
      const std::uint32_t step = std::min(cycles, left);
      registers.Value = left - step;
      cycles -= step;
      icsr = registers.Value == 0 ? pending : icsr;
    }
  }
  void alarm(std::uint32_t ticks) {
    SysTickDriver.Alarm(&timer, ticks);
    ++total;  // the driver starts the counter twice
    load();
  }
  /// Executes a pending interrupt. Returns false if there is none.
  bool interrupt() {
    if ((icsr & pending) == 0) {
      return false;
    }
    icsr = 0;
    run(registers.Value == 0 ? 1 : 0);  // latency of the interrupt
    COSysTickInterrupt(&timer);
    return true;
  }
  std::uint32_t now() { return SysTickDriver.Now(&timer); }
  std::uint32_t expected() const { return static_cast<std::uint32_t>(total / cycles_per_tick); }

  CO_SYSTICK_REGS registers{};
  std::uint32_t icsr = 0;
  CO_SYSTICK timer{&registers, &icsr, cycles_per_tick* mega, {}, 0, 0, 0, 0};
  std::uint64_t total = 0;
};

struct Mtime {
  explicit Mtime(std::uint64_t start) : at(start) {
    set();
    MtimeDriver.Init(&timer, mega);
  }
  void run(std::uint64_t cycles) {
    at += cycles;
    set();
  }
  void set() {
    time[0] = static_cast<std::uint32_t>(at);
    time[1] = static_cast<std::uint32_t>(at >> 32);
  }
  std::uint64_t due() const { return std::uint64_t{compare[1]} << 32 | compare[0]; }
  std::uint32_t now() { return MtimeDriver.Now(&timer); }

  std::uint64_t at;
  volatile std::uint32_t time[2] = {};
  volatile std::uint32_t compare[2] = {};
  CO_MTIME timer{time, compare, 10 * mega, {}, 0};
};

}  // namespace

TEST_CASE("systick: the clock counts ticks, independent of alarms") {
  SysTick systick;
  CHECK(systick.now() == 0);
  systick.run(23);
  CHECK(systick.now() == 0);
  systick.run(1);
  CHECK(systick.now() == 1);
  systick.alarm(1000);
  CHECK(systick.now() == 1);
  systick.run(20);
  systick.alarm(7);
  CHECK(systick.now() == 1);
  systick.run(1);
  CHECK(systick.now() == 2);
  CHECK((systick.registers.Control & 7u) == 7);
}

TEST_CASE("systick: an alarm interrupts in the first cycle of its tick") {
  SysTick systick;
  systick.run(10);
  systick.alarm(100);
  systick.run(100 * cycles_per_tick - 13 - 1);
  CHECK_FALSE(systick.interrupt());
  systick.run(1);
  CHECK(systick.now() == 100);
  CHECK(systick.interrupt());
  CHECK(systick.now() == 100);
}

TEST_CASE("systick: a late interrupt and a read of the clock before it keep the time") {
  SysTick systick;
  systick.alarm(100);
  systick.run(100 * cycles_per_tick - 3);
  CHECK(systick.now() == 100);
  systick.run(1);
  CHECK(systick.now() == 100);
  systick.run(longest_slice / 2 - 1);
  CHECK(systick.now() == systick.expected());
  CHECK(systick.interrupt());
  CHECK(systick.now() == systick.expected());
  systick.alarm(5);
  CHECK(systick.now() == systick.expected());
}

TEST_CASE("systick: an alarm replaced while it is pending does not interrupt, and no time is lost") {
  SysTick systick;
  systick.alarm(100);
  systick.run(100 * cycles_per_tick + 30);
  systick.alarm(50);
  CHECK_FALSE(systick.interrupt());
  CHECK(systick.now() == 101);
  systick.run(151 * cycles_per_tick - 1 - static_cast<std::uint32_t>(systick.total));
  CHECK_FALSE(systick.interrupt());
  systick.run(1);
  CHECK(systick.interrupt());
  CHECK(systick.now() == 151);
}

TEST_CASE("systick: late alarms and times without an alarm are counted in steps of the counter range") {
  for (const std::uint32_t ticks : std::initializer_list<std::uint32_t>{0u, longest_slice, UINT32_MAX}) {
    SysTick systick;
    systick.alarm(ticks);
    for (unsigned n = 0; n < 600; ++n) {  // more than 2^32 cycles
      systick.run(systick.timer.Slice - 2);
      CHECK_FALSE(systick.interrupt());
      systick.run(1);
      CHECK(systick.now() == systick.expected());
      CHECK(systick.interrupt());
      CHECK(systick.now() == systick.expected());
      systick.alarm(ticks);
    }
  }
}

TEST_CASE("systick: any sequence of alarms, late interrupts and reads keeps the time to the cycle") {
  std::mt19937 generator(1);
  const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
  SysTick systick;
  std::uint32_t due = 0;
  unsigned interrupts = 0;
  for (unsigned n = 0; n < 200000 / test::stride(40); ++n) {
    const std::uint32_t ticks = (random() & 1u) != 0 ? random() % 500 : random() % 671000;
    if ((random() & 3u) == 0) {
      due = ticks == 0 ? 0 : systick.now() + ticks;
      systick.alarm(ticks);
    }
    const bool is_long = (random() & 7u) == 0;
    systick.run(random() % (is_long ? longest_slice / 2 - 100000 : 3000));
    REQUIRE(systick.now() == systick.expected());
    if ((is_long || (random() & 1u) != 0) && systick.interrupt()) {
      ++interrupts;
      REQUIRE(systick.now() == systick.expected());
      REQUIRE((due == 0 || static_cast<std::int32_t>(systick.now() - due) >= 0));
      systick.alarm(0);
      due = 0;
    }
  }
  CHECK(interrupts > 1000 / test::stride(40));
}

TEST_CASE("mtime: ticks and alarms are exact to the cycle across the wrap of the low word") {
  for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{0xFFFFFFF0}, std::uint64_t{0x1FFFFFFFF}}) {
    CAPTURE(start);
    Mtime mtime(start);
    CHECK(mtime.due() == start + (1u << 31));
    CHECK(mtime.now() == 0);
    mtime.run(9);
    CHECK(mtime.now() == 0);
    MtimeDriver.Alarm(&mtime.timer, 100);
    CHECK(mtime.due() == start + 1000);
    mtime.run(991);
    CHECK(mtime.now() == 100);
    MtimeDriver.Alarm(&mtime.timer, 1);
    CHECK(mtime.due() == start + 1010);
    mtime.run(25);
    CHECK(mtime.now() == 102);
  }
}

TEST_CASE("mtime: late alarms are counted in steps, and ticks continue across all wraps") {
  Mtime mtime(5);
  std::uint64_t total = 0;
  for (const std::uint32_t ticks : std::initializer_list<std::uint32_t>{0u, 1u << 31, UINT32_MAX, 214748365u}) {
    MtimeDriver.Alarm(&mtime.timer, ticks);
    CHECK(mtime.due() == mtime.at + (1u << 31));
  }
  for (unsigned n = 0; n < 100; ++n) {  // more than 2^32 ticks
    mtime.run((1u << 31) + n);
    total += (1u << 31) + n;
    CHECK(mtime.now() == static_cast<std::uint32_t>(total / 10));
    MtimeDriver.Alarm(&mtime.timer, 0);
    CHECK(mtime.now() == static_cast<std::uint32_t>(total / 10));
  }
}

TEST_CASE("nrf51: Init starts a 32-bit clock with the frequency; Alarm enables and disables its interrupt") {
  CO_NRF51_TIMER_REGS registers{};
  CO_NRF51_TIMER timer{&registers};
  Nrf51TimerDriver.Init(&timer, mega);
  CHECK(registers.Start == 1);
  CHECK(registers.BitMode == 3);
  CHECK(registers.Prescaler == 4);
  for (const std::uint32_t now : {0u, 0xFFFFFFF0u}) {
    registers.Compare[0] = now;  // the register that captures the clock
    registers.Compared[1] = 1;
    CHECK(Nrf51TimerDriver.Now(&timer) == now);
    Nrf51TimerDriver.Alarm(&timer, 1000);
    CHECK(registers.Compare[1] == now + 1000);
    CHECK(registers.Compared[1] == 0);
    CHECK(registers.InterruptsOn == 1u << 17);
    registers.InterruptsOn = 0;
    Nrf51TimerDriver.Alarm(&timer, 1);
    CHECK(registers.Compare[1] - now >= 1);
    CHECK(registers.Compare[1] - now < 10);
    registers.InterruptsOn = 0;
    Nrf51TimerDriver.Alarm(&timer, 0);
    CHECK(registers.InterruptsOff == 1u << 17);
    CHECK(registers.InterruptsOn == 0);
  }
}

TEST_CASE("nrf51: the frequency is 16 MHz divided by a power of two") {
  CO_NRF51_TIMER_REGS registers{};
  CO_NRF51_TIMER timer{&registers};
  const std::uint32_t frequencies[] = {16000000, 8000000, 31250, 1};
  const std::uint32_t prescalers[] = {0, 1, 9, 9};
  for (unsigned n = 0; n < 4; ++n) {
    Nrf51TimerDriver.Init(&timer, frequencies[n]);
    CHECK(registers.Prescaler == prescalers[n]);
  }
}
