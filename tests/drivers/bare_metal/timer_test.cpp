// SPDX-License-Identifier: Apache-2.0
// Tests the timer driver of a board on the emulated board: alarms of random length, one after the other, and the
// driver's clock compared with a second one. The time is that of the emulated instructions (-icount), so every run is
// the same. The program does not sleep, because QEMU may let time pass before it wakes a CPU.
#include "bare_metal/parts.hpp"
#include "board.hpp"
#include "reference.hpp"

namespace {

using lexican::demo::BoardTimer;

constexpr std::uint32_t ticks_per_second = 1000000;
constexpr std::uint32_t latest = 50;  // ticks that interrupt and driver may take, with a margin
constexpr std::uint32_t duration = 5 * ticks_per_second;

BoardTimer timer;
volatile std::uint32_t due;
volatile std::uint32_t came;  // time of the alarm
volatile bool waiting;

std::uint32_t now() { return timer.driver->Now(timer.context); }

// Returns the next pseudo-random number of a fixed sequence.
std::uint32_t random_number() {
  static std::uint32_t state = 1;
  state = state * 1664525u + 1013904223u;
  return state >> 8;
}

// Returns a random delay: mostly up to 200 us or 20 ms, sometimes up to 2 s, which is longer than a driver's longest
// step.
std::uint32_t random_delay() {
  switch (random_number() % 32) {
    case 0: return random_number() % 2000000u + 1;
    case 1:
    case 2:
    case 3:
    case 4: return random_number() % 20000u + 1;
    default: return random_number() % 200u + 1;
  }
}

void wait_for(std::uint32_t delay) {
  const std::uint32_t before = board::disable_interrupts();
  due = now() + delay;
  waiting = true;
  timer.driver->Alarm(timer.context, delay);
  board::restore_interrupts(before);
  while (waiting) {
    test::look_at_reference();
  }
}

[[noreturn]] void fail(const char* what, std::uint32_t delay, std::uint32_t ticks) {
  board::print(what);
  board::print(": delay ");
  board::print_hex(delay);
  board::print("h ticks, off by ");
  board::print_hex(ticks);
  board::print("h\n");
  board::leave(1);
}

}  // namespace

namespace board {

void on_uart() {}

// Processes a timer interrupt like COTmrService(): one before the alarm is an intermediate step of the driver.
void on_timer() {
  lexican::demo::timer_interrupt();
  const std::uint32_t time = now();
  const std::uint32_t left = due - time;
  if (waiting && left != 0 && left <= UINT32_MAX / 2) {
    timer.driver->Alarm(timer.context, left);
    return;
  }
  came = time;
  waiting = false;
  timer.driver->Alarm(timer.context, 0);
}

}  // namespace board

int main() {
  board::disable_interrupts();
  timer = lexican::demo::board_timer();
  timer.driver->Init(timer.context, ticks_per_second);
  board::enable_interrupts();
  test::start_reference();
  const std::uint32_t begin = now();
  std::uint32_t alarms = 0;
  while (now() - begin < duration) {
    const std::uint32_t delay = random_delay();
    wait_for(delay);
    ++alarms;
    const std::uint32_t late = came - due;
    if (late > latest) {
      fail(late > UINT32_MAX / 2 ? "early" : "late", delay, late);
    }
  }
  const std::uint32_t other = test::reference_ticks();
  const std::uint32_t drift = now() - begin - other;
  board::print_hex(alarms);
  board::print("h alarms, drift ");
  board::print_hex(drift);
  board::print("h ticks\n");
  return drift + test::drift_allowed <= 2 * test::drift_allowed ? 0 : 1;
}
