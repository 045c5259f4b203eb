// SPDX-License-Identifier: Apache-2.0
// Virtual clock, and the timer that counts ticks of the application.
#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "co_timer_software.h"
#include "virtual_clock.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualClock;
using co::VirtualTimer;
using co::VirtualTimerDriver;

}  // namespace

TEST_CASE("virtual clock: it advances only by calls and wraps at 2^32 for the nodes") {
  VirtualClock clock(0xFFFFFFFE);
  VirtualTimer timer(clock);
  CHECK(VirtualTimerDriver.Now(&timer) == 0xFFFFFFFE);
  CHECK(VirtualTimerDriver.Now(&timer) == 0xFFFFFFFE);
  clock.advance(5);
  CHECK(VirtualTimerDriver.Now(&timer) == 3);
  CHECK(clock.elapsed() == 5);
}

TEST_CASE("virtual clock: time and ticks are exact at any frequency, with ticks rounded up") {
  VirtualClock clock;
  CHECK(clock.time() == 0us);
  CHECK(clock.ticks(1s) == 0);  // no frequency yet
  VirtualTimer timer(clock);
  VirtualTimerDriver.Init(&timer, 300);
  CHECK(clock.frequency() == 300);
  CHECK(clock.ticks(0us) == 0);
  CHECK(clock.ticks(-1us) == 0);
  CHECK(clock.ticks(1us) == 1);
  CHECK(clock.ticks(10ms) == 3);
  CHECK(clock.ticks(10ms + 1us) == 4);
  CHECK(clock.ticks(24h) == 25920000);
  clock.advance(1);
  CHECK(clock.time() == 3333us);
  clock.advance(25920000 - 1);
  CHECK(clock.time() == 24h);
  clock.set_frequency(72000000);
  CHECK(clock.ticks(10 * 365 * 24h) == 10ull * 365 * 86400 * 72000000);
}

TEST_CASE("virtual clock: each alarm elapses once on its tick and in order") {
  VirtualClock clock(1000);
  std::vector<std::string> calls;
  const auto record = [&](const char* name) {
    return [&, name] { calls.push_back(name + std::to_string(clock.now())); };
  };
  VirtualTimer a(clock, record("a"));
  VirtualTimer b(clock, record("b"));
  VirtualTimer c(clock, record("c"));
  VirtualTimerDriver.Alarm(&c, 7);
  VirtualTimerDriver.Alarm(&b, 5);
  VirtualTimerDriver.Alarm(&a, 7);
  CHECK(clock.next_alarm() == 5);
  clock.advance(4);
  CHECK(calls.empty());
  CHECK(clock.next_alarm() == 1);
  clock.advance(100);
  CHECK(calls == std::vector<std::string>{"b1005", "a1007", "c1007"});
  CHECK(clock.now() == 1104);
  CHECK(clock.next_alarm() == VirtualClock::never);
  CHECK(a.alarms() == 1);
}

TEST_CASE("virtual clock: an alarm is replaced by the next one and deleted by 0") {
  VirtualClock clock;
  VirtualTimer timer(clock);
  timer.set_alarm(10);
  timer.set_alarm(20);
  clock.advance(15);
  CHECK(timer.alarms() == 0);
  CHECK(timer.armed());
  timer.set_alarm(0);
  CHECK_FALSE(timer.armed());
  clock.advance(100);
  CHECK(timer.alarms() == 0);
  timer.set_alarm(5);
  VirtualTimerDriver.Init(&timer, 1000);
  CHECK_FALSE(timer.armed());
}

TEST_CASE("virtual clock: an alarm function that sets the next alarm is called again within the same advance") {
  VirtualClock clock;
  std::unique_ptr<VirtualTimer> timer;
  std::vector<std::uint32_t> calls;
  timer = std::make_unique<VirtualTimer>(clock, [&] {
    calls.push_back(clock.now());
    timer->set_alarm(10);
  });
  timer->set_alarm(10);
  clock.advance(35);
  CHECK(calls == std::vector<std::uint32_t>{10, 20, 30});
}

TEST_CASE("virtual clock: a simulation can advance to the next alarm") {
  VirtualClock clock(0xFFFFFFFF);
  VirtualTimer a(clock);
  VirtualTimer b(clock);
  CHECK_FALSE(clock.advance_to_alarm());
  CHECK(clock.elapsed() == 0);
  a.set_alarm(0x80000000);
  b.set_alarm(3);
  CHECK(clock.advance_to_alarm());
  CHECK(clock.elapsed() == 3);
  CHECK(clock.advance_to_alarm());
  CHECK(clock.elapsed() == 0x80000000);
  CHECK_FALSE(clock.advance_to_alarm());
}

TEST_CASE("virtual clock: an alarm function may advance the clock and destroy its timer") {
  VirtualClock clock;
  std::unique_ptr<VirtualTimer> timer;
  timer = std::make_unique<VirtualTimer>(clock, [&] {
    clock.advance(50);
    timer.reset();
  });
  timer->set_alarm(10);
  clock.advance(20);
  CHECK(clock.elapsed() == 60);
  CHECK(timer == nullptr);
  CHECK(clock.next_alarm() == VirtualClock::never);
}

TEST_CASE("software timer: counts calls of Update and reports the end once") {
  const CO_IF_TIMER_DRV& driver = SoftwareTimerDriver;
  driver.Init(1000);
  CHECK(driver.Update() == 0);
  CHECK(driver.Delay() == 0);
  driver.Reload(3);
  driver.Start();
  CHECK(driver.Delay() == 3);
  CHECK(driver.Update() == 0);
  CHECK(driver.Delay() == 2);
  CHECK(driver.Update() == 0);
  CHECK(driver.Update() == 1);
  CHECK(driver.Delay() == 0);
  CHECK(driver.Update() == 0);
}

TEST_CASE("software timer: it can be stopped and restarted with a new time") {
  const CO_IF_TIMER_DRV& driver = SoftwareTimerDriver;
  driver.Reload(1);
  driver.Stop();
  CHECK(driver.Update() == 0);
  driver.Reload(5);
  driver.Update();
  driver.Reload(1);
  CHECK(driver.Update() == 1);
  driver.Reload(UINT32_MAX);
  CHECK(driver.Update() == 0);
  CHECK(driver.Delay() == UINT32_MAX - 1);
  driver.Init(1000);
  CHECK(driver.Delay() == 0);
}

TEST_CASE("software timer: a restart on the tick of the end does not drift") {
  const CO_IF_TIMER_DRV& driver = SoftwareTimerDriver;
  driver.Init(1000);
  driver.Reload(7);
  int elapsed = 0;
  for (int tick = 1; tick <= 700; ++tick) {
    if (driver.Update() == 1) {
      CHECK(tick % 7 == 0);
      ++elapsed;
      driver.Reload(7);
    }
  }
  CHECK(elapsed == 100);
  driver.Stop();
}
