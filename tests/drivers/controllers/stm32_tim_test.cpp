// SPDX-License-Identifier: Apache-2.0
// The driver stm32_tim on a model of the registers of a timer with 16 and with 32 bits.
#include "stm32_tim.hpp"

#include <doctest/doctest.h>

#include <random>

#include "co_driver_check.h"
#include "co_timer_stm32_tim.h"

namespace {

using test::Stm32Tim;

constexpr std::uint32_t mega = 1000000;
constexpr std::uintptr_t address = 0x40000400;

struct Board {
  explicit Board(std::uint32_t bits, std::uint32_t hz = 84 * mega, std::uint32_t freq = mega)
      : tim(address, bits), per_tick(hz / freq) {
    timer.Regs = CO_STM32_TIM3;
    timer.Hz = hz;
    timer.Bits = bits;
    Stm32TimDriver.Init(&timer, freq);
  }
  void run(std::uint64_t cycles) {
    total += cycles;
    tim.run(cycles);
  }
  std::uint32_t now() { return Stm32TimDriver.Now(&timer); }
  void alarm(std::uint32_t ticks) { Stm32TimDriver.Alarm(&timer, ticks); }
  /// Executes a pending interrupt. Returns false if there is none.
  bool interrupt() {
    if (!tim.interrupt()) {
      return false;
    }
    COStm32TimInterrupt(&timer);
    return true;
  }
  std::uint32_t expected() const { return static_cast<std::uint32_t>(total / per_tick); }

  Stm32Tim tim;
  CO_STM32_TIM timer{};
  std::uint64_t per_tick;
  std::uint64_t total = 0;
};

TEST_CASE("stm32_tim: the prescaler divides the clock to the frequency of ticks or to a multiple of it") {
  struct Divisor {
    std::uint32_t hz, freq, prescaler, per_tick;
  };
  const Divisor divisors[] = {
      {84 * mega, mega, 84, 1}, {84 * mega, 1000, 42000, 2}, {170 * mega, 1000, 42500, 4}, {64 * mega, 1000, 64000, 1},
      {65536, 1, 65536, 1},     {65537, 1, 1, 65537},        {mega, mega, 1, 1},           {mega, 0, 1, 1},
      {1000, mega, 1, 1},       {275 * mega, 1000, 55000, 5}};
  for (const Divisor& one : divisors) {
    CAPTURE(one.hz);
    CAPTURE(one.freq);
    Board board(32, one.hz, one.freq == 0 ? one.hz : one.freq);
    if (one.freq == 0 || one.freq > one.hz) {
      Stm32TimDriver.Init(&board.timer, one.freq);
    }
    CHECK(board.tim.prescaler() + 1 == one.prescaler);
    CHECK(board.timer.Clock.PerTick == one.per_tick);
  }
}

TEST_CASE("stm32_tim: the clock counts ticks across wraps of the counter") {
  for (const std::uint32_t bits : {16U, 32U}) {
    CAPTURE(bits);
    Board board(bits);
    CHECK(board.now() == 0);
    board.run(83);
    CHECK(board.now() == 0);
    board.run(1);
    CHECK(board.now() == 1);
    for (unsigned n = 0; n < 1000; ++n) {
      board.run(84U * 1000 + n);
      REQUIRE(board.now() == board.expected());
      board.interrupt();
      REQUIRE(board.now() == board.expected());
    }
    CHECK(board.tim.fault_text() == "");
  }
}

TEST_CASE("stm32_tim: an alarm interrupts at its tick and not before") {
  for (const std::uint32_t bits : {16U, 32U}) {
    for (const std::uint32_t ticks : {1U, 2U, 100U, 32767U, 32768U}) {
      CAPTURE(bits);
      CAPTURE(ticks);
      Board board(bits);
      board.run(60000 * 84 + 10);
      board.alarm(ticks);
      board.run(std::uint64_t{84} * ticks - 11);
      while (board.interrupt()) {  // the counter has wrapped
        REQUIRE(board.now() == board.expected());
        board.alarm(60000 + ticks - board.now());
      }
      board.run(1);
      CHECK(board.tim.interrupt());
      CHECK(board.now() == 60000 + ticks);
    }
  }
}

TEST_CASE("stm32_tim: an alarm that is replaced or cancelled does not interrupt") {
  Board board(32);
  board.alarm(10);
  board.run(84 * 20);
  CHECK(board.tim.interrupt());
  board.alarm(0);
  CHECK_FALSE(board.tim.interrupt());
  board.run(84 * 100000);
  CHECK_FALSE(board.tim.interrupt());
  board.alarm(10);
  board.alarm(20);
  board.run(84 * 19);
  CHECK_FALSE(board.tim.interrupt());
  board.run(84);
  CHECK(board.tim.interrupt());
}

TEST_CASE("stm32_tim: an alarm that becomes due while it is set is not lost") {
  for (const std::uint32_t cycles : {0U, 20U, 84U, 200U, 1000U}) {
    CAPTURE(cycles);
    Board board(16);
    board.tim.cycles_per_access = cycles;
    board.alarm(1);
    board.tim.cycles_per_access = 0;
    board.tim.run(84);
    CHECK(board.tim.interrupt());
  }
}

TEST_CASE("stm32_tim: late alarms are reached in steps and the clock continues for more than 2^32 counts") {
  for (const std::uint32_t bits : {16U, 32U}) {
    for (const std::uint32_t ticks : {0U, 0x80000001U, 0xFFFFFFFFU}) {
      CAPTURE(bits);
      Board board(bits, 84 * mega, 1000);  // two counts a tick
      board.alarm(ticks);
      const std::uint64_t step = std::uint64_t{42000} * (bits == 16 ? 32768 : 0x80000000);
      for (unsigned n = 0; n < (bits == 16 ? 3000 : 20); ++n) {
        board.run(step);
        REQUIRE(board.now() == board.expected());
        REQUIRE(board.interrupt());
        REQUIRE(board.now() == board.expected());
      }
    }
  }
}

TEST_CASE("stm32_tim: a wrap of the counter between any two accesses of a reading does not change the result") {
  for (const bool are_interrupts_enabled : {false, true}) {
    for (unsigned moment = 0; moment < 400; ++moment) {
      Board board(16);
      board.run(84 * 40000);
      board.interrupt();
      board.run(84 * 25536 - 200 + moment);
      bool is_interrupted = !are_interrupts_enabled;
      board.tim.cycles_per_access = 7;
      board.tim.on_access = [&] {
        if (!is_interrupted && board.tim.interrupt()) {
          is_interrupted = true;
          board.interrupt();
          is_interrupted = false;
        }
      };
      const std::uint32_t before = static_cast<std::uint32_t>(board.tim.counted());
      const std::uint32_t now = board.now();
      const std::uint32_t after = static_cast<std::uint32_t>(board.tim.counted());
      REQUIRE(now - before <= after - before);
    }
  }
}

TEST_CASE("stm32_tim: an alarm of an interrupt between any two accesses of a reading does not change the result") {
  for (unsigned moment = 0; moment < 400; ++moment) {
    Board board(32, 84 * mega, 1000);  // two counts a tick
    board.run(std::uint64_t{42000} * 2001);
    unsigned accesses = 0;
    board.tim.on_access = [&] {
      if (++accesses == moment % 4) {
        board.run(42000);
        board.alarm(50);
      }
    };
    const std::uint32_t before = board.expected();
    const std::uint32_t now = board.now();
    REQUIRE(now - before <= board.expected() - before);
  }
}

TEST_CASE("stm32_tim: an alarm that is set while a wrap is pending keeps the time") {
  Board board(16);
  board.run(84 * 65536);
  board.alarm(5);
  CHECK(board.now() == 65536);
  CHECK(board.interrupt());
  CHECK(board.now() == 65536);
  board.run(84 * 5);
  CHECK(board.tim.interrupt());
}

TEST_CASE("stm32_tim: without an alarm the clock continues in steps of half of the range") {
  Board board(32, 84 * mega, 1000);  // two counts a tick
  for (unsigned n = 0; n < 5; ++n) {
    board.run(std::uint64_t{42000} << 31);
    REQUIRE(board.interrupt());
    REQUIRE(board.now() == board.expected());
  }
}

TEST_CASE("stm32_tim: Init starts the clock again without the flags of the time before") {
  for (const std::uint32_t bits : {16U, 32U}) {
    Board board(bits);
    board.alarm(5);
    board.run(84 * 70000);
    CHECK(board.tim.interrupt());
    Stm32TimDriver.Init(&board.timer, mega);
    CHECK_FALSE(board.tim.interrupt());
    CHECK(board.now() == 0);
    CHECK(board.tim.fault_text() == "");
  }
}

TEST_CASE("stm32_tim: any sequence of alarms, late interrupts and readings keeps the time") {
  for (const std::uint32_t bits : {16U, 32U}) {
    CAPTURE(bits);
    std::mt19937 generator(bits);
    const auto random = [&](std::uint32_t below) { return static_cast<std::uint32_t>(generator()) % below; };
    Board board(bits);
    std::uint32_t due = 0;
    unsigned interrupts = 0;
    for (unsigned n = 0; n < 100000; ++n) {
      if (random(4) == 0) {
        const std::uint32_t ticks = 1 + random(random(2) == 0 ? 500 : 300000);
        due = board.now() + ticks;
        board.alarm(ticks);
      }
      board.run(random(random(8) == 0 ? 84 * 60000 : 84 * 300));
      REQUIRE(board.now() == board.expected());
      const bool is_due = due != 0 && static_cast<std::int32_t>(board.now() - due) >= 0;
      if (is_due && static_cast<std::int32_t>(board.now() - due) < 30000 && due % 2 == 0) {
        REQUIRE(board.tim.interrupt());
      }
      while (board.interrupt()) {  // as COTmrService(): continues an alarm that is not due
        ++interrupts;
        REQUIRE(board.now() == board.expected());
        const bool is_over = due == 0 || static_cast<std::int32_t>(board.now() - due) >= 0;
        due = is_over ? 0 : due;
        if (!is_over) {
          board.alarm(due - board.now());
        }
      }
    }
    CHECK(interrupts > 1000);
    CHECK(board.tim.fault_text() == "");
  }
}

struct Check {
  Board board;
  CO_DRIVER_CHECK check{};
  std::vector<std::string> failures;
};

TEST_CASE("stm32_tim: the driver check passes") {
  for (const std::uint32_t bits : {16U, 32U}) {
    CAPTURE(bits);
    Check one{Board(bits), {}, {}};
    CO_NODE_EXT ext{};
    ext.Size = sizeof ext;
    ext.Timer = &Stm32TimDriver;
    ext.TimerCtx = &one.board.timer;
    one.check.Ext = &ext;
    one.check.User = &one;
    one.check.TmrFreq = mega;
    one.check.Late = 2;
    one.check.Longest = 40000;
    one.check.Print = [](void* user, const char* line) {
      const std::string text = line;
      if (text.rfind("not ok", 0) == 0) {
        static_cast<Check*>(user)->failures.push_back(text);
      }
    };
    one.check.Clock = [](void* user) {
      return static_cast<std::uint32_t>(static_cast<Check*>(user)->board.tim.counted());
    };
    one.check.Idle = [](void* user) {
      Check& self = *static_cast<Check*>(user);
      self.board.tim.run(84);
      if (self.board.interrupt()) {
        CODriverCheckService(&self.check);
      }
    };
    CODriverCheckTimer(&one.check);
    CHECK(one.failures == std::vector<std::string>{});
    CHECK(one.check.Passed >= 7);
  }
}

}  // namespace
