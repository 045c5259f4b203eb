// SPDX-License-Identifier: Apache-2.0
// Timer of Linux: conversions at every frequency, alarms, and waits that are never too short.
#include <doctest/doctest.h>

#ifdef __linux__

#include <poll.h>
#include <time.h>
#include <unistd.h>

#include <climits>
#include <cstdint>
#include <initializer_list>

#include "linux_timer.hpp"

namespace {

using co::LinuxTimer;
using co::LinuxTimerDriver;
using co::ns_from_ticks;
using co::ticks_from_ns;

constexpr std::uint64_t ms = 1000000;
constexpr std::uint64_t second = 1000 * ms;

std::uint64_t fake_now = 0;
std::uint64_t fake_clock() { return fake_now; }

std::uint64_t monotonic_ms() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1000 + static_cast<std::uint64_t>(time.tv_nsec) / ms;
}

constexpr std::uint32_t hour = 3600 * 1000;  // ticks at 1 kHz
constexpr int minutes = 10 * 60 * 1000;      // limit for a busy machine, ms

bool readable(int fd, int timeout) {
  pollfd wait{fd, POLLIN, 0};
  return poll(&wait, 1, timeout) == 1;
}

}  // namespace

TEST_CASE("linux timer: nanoseconds become ticks exactly, at any frequency and for years") {
  CHECK(ticks_from_ns(second, 300) == 300);
  CHECK(ticks_from_ns(3333333, 300) == 0);
  CHECK(ticks_from_ns(3333334, 300) == 1);
  CHECK(ticks_from_ns(second - 1, 1024) == 1023);
  CHECK(ticks_from_ns(second, 32768) == 32768);
  CHECK(ticks_from_ns(1500, 1000000) == 1);
  CHECK(ticks_from_ns(13, 72000000) == 0);
  CHECK(ticks_from_ns(14, 72000000) == 1);
  CHECK(ticks_from_ns(2 * second - 1, 1) == 1);
  CHECK(ticks_from_ns(second, UINT32_MAX) == UINT32_MAX);
  CHECK(ticks_from_ns(100ull * 365 * 86400 * second, 300) == 100ull * 365 * 86400 * 300);
  CHECK(ticks_from_ns(second, 0) == 0);
}

TEST_CASE("linux timer: a tick begins with its first nanosecond") {
  for (const std::uint32_t frequency : {1u, 3u, 300u, 1000u, 1024u, 32768u, 1000000u, 72000000u}) {
    for (const std::uint64_t tick : {1ull, 2ull, 299ull, 1000001ull, 4294967297ull}) {
      CAPTURE(frequency);
      CAPTURE(tick);
      const std::uint64_t begin = ns_from_ticks(tick, frequency);
      CHECK(ticks_from_ns(begin, frequency) == tick);
      CHECK(ticks_from_ns(begin - 1, frequency) == tick - 1);
    }
  }
}

TEST_CASE("linux timer: starts at 0, wraps at 2^32 and has no drift") {
  fake_now = 123456789;
  LinuxTimer timer(fake_clock);
  LinuxTimerDriver.Init(&timer, 1000000);
  CHECK(LinuxTimerDriver.Now(&timer) == 0);
  fake_now += 4294967295ull * 1000;
  CHECK(LinuxTimerDriver.Now(&timer) == 0xFFFFFFFF);
  fake_now += 1000;
  CHECK(LinuxTimerDriver.Now(&timer) == 0);
  LinuxTimerDriver.Init(&timer, 300);
  for (int i = 0; i < 1000; ++i) {
    fake_now += 3333333;  // slightly less than a tick each
  }
  CHECK(LinuxTimerDriver.Now(&timer) == 999);
}

TEST_CASE("linux timer: stores the alarm, which the next one replaces and 0 deletes") {
  fake_now = 0;
  LinuxTimer timer(fake_clock);
  CHECK(timer.until_alarm() == LinuxTimer::never);
  timer.start(1000);
  LinuxTimerDriver.Alarm(&timer, 10);
  CHECK(timer.until_alarm() == 10);
  fake_now = 9 * ms + ms / 2;
  CHECK(timer.until_alarm() == 1);
  fake_now = 10 * ms;
  CHECK(timer.until_alarm() == 0);
  fake_now = 50 * ms;
  CHECK(timer.until_alarm() == 0);
  LinuxTimerDriver.Alarm(&timer, 0xFFFFFFFF);
  CHECK(timer.until_alarm() == 0xFFFFFFFE);  // UINT32_MAX means never
  LinuxTimerDriver.Alarm(&timer, 5);
  CHECK(timer.until_alarm() == 5);
  LinuxTimerDriver.Alarm(&timer, 0);
  CHECK(timer.until_alarm() == LinuxTimer::never);
}

TEST_CASE("linux timer: a wait ends on its tick and never before") {
  fake_now = 0;
  LinuxTimer timer(fake_clock);
  timer.start(300);
  fake_now = 1 * ms;  // within tick 0
  CHECK(timer.wait_ns(1) == 2333334);
  CHECK(timer.wait_ns(3) == 9 * ms);
  fake_now += timer.wait_ns(1);
  CHECK(timer.now() == 1);
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t before = timer.now();
    const std::uint64_t wait = timer.wait_ns(7);
    fake_now += wait - 1;
    CHECK(timer.now() == before + 6);
    fake_now += 1;
    CHECK(timer.now() == before + 7);
    fake_now += 12345 * static_cast<std::uint64_t>(i);
  }
}

TEST_CASE("linux timer: time-outs for poll and ppoll are rounded up, so that no loop polls") {
  fake_now = 0;
  LinuxTimer timer(fake_clock);
  timer.start(1000000);
  CHECK(timer.poll_timeout(0) == 0);
  CHECK(timer.poll_timeout(1) == 1);
  CHECK(timer.poll_timeout(1000) == 1);
  CHECK(timer.poll_timeout(1001) == 2);
  CHECK(timer.poll_timeout(LinuxTimer::never) == -1);
  timespec storage{};
  CHECK(timer.ppoll_timeout(LinuxTimer::never, storage) == nullptr);
  REQUIRE(timer.ppoll_timeout(2500000, storage) == &storage);
  CHECK(storage.tv_sec == 2);
  CHECK(storage.tv_nsec == 500000000);
  REQUIRE(timer.ppoll_timeout(0, storage) == &storage);
  CHECK(storage.tv_sec == 0);
  CHECK(storage.tv_nsec == 0);
  timer.start(1);
  CHECK(timer.poll_timeout(0xFFFFFFFE) == INT_MAX);
}

TEST_CASE("linux timer: without a frequency the time does not advance and no alarm elapses") {
  fake_now = 0;
  LinuxTimer timer(fake_clock);
  timer.start(0);
  fake_now = second;
  CHECK(timer.now() == 0);
  timer.set_alarm(1);
  CHECK(timer.until_alarm() == LinuxTimer::never);
  CHECK(timer.poll_timeout(5) == -1);
}

TEST_CASE("linux timer: uses the monotonic clock") {
  LinuxTimer timer;
  const std::uint64_t before_start = monotonic_ms();
  timer.start(1000);
  const std::uint64_t after_start = monotonic_ms();
  usleep(20000);
  const std::uint64_t before = monotonic_ms();
  const std::uint32_t now = timer.now();
  const std::uint64_t after = monotonic_ms();
  CHECK(now >= 20);
  CHECK(now + 1 >= before - after_start);  // the times of both ends are rounded down
  CHECK(now <= after - before_start + 1);
}

TEST_CASE("linux timer: the descriptor is readable from the alarm until it is replaced") {
  LinuxTimer timer;
  timer.start(1000);
  timer.set_alarm(30);
  const int fd = timer.fd();  // created while an alarm is set
  REQUIRE(fd >= 0);
  CHECK(timer.fd() == fd);
  CHECK(readable(fd, minutes));
  CHECK(timer.until_alarm() == 0);
  CHECK(readable(fd, 0));
  timer.set_alarm(hour);
  CHECK_FALSE(readable(fd, 0));
  timer.set_alarm(5);
  CHECK(readable(fd, minutes));
  CHECK(timer.until_alarm() == 0);
  timer.set_alarm(0);
  CHECK_FALSE(readable(fd, 20));
  LinuxTimer later;
  later.start(1000);
  later.set_alarm(hour);
  CHECK_FALSE(readable(later.fd(), 0));
}

TEST_CASE("linux timer: a descriptor created after the alarm has elapsed is readable at once") {
  LinuxTimer timer;
  timer.start(1000);
  timer.set_alarm(1);
  usleep(3000);
  CHECK(readable(timer.fd(), minutes));
}

#endif
