// SPDX-License-Identifier: Apache-2.0
// The clock and the alarm of a fixture, and its loop, which sleeps until the next wake-up.
#include <algorithm>

#include "fixture.hpp"

namespace test {
namespace {

constexpr unsigned patience = 200;  // maximum number of wake-ups at one tick; more mean an endless loop

std::uint64_t divided_up(std::uint64_t dividend, std::uint64_t divisor) { return (dividend + divisor - 1) / divisor; }

}  // namespace

std::uint64_t Fixture::ticks(Time time) const {
  return divided_up(static_cast<std::uint64_t>(time.count()) * setup_.rate_, 1000000);
}

std::uint64_t Fixture::next_wake() const {
  if (setup_.wake_ == Wake::every_tick) {
    return now_ + 1;
  }
  if (setup_.wake_ == Wake::alarm) {
    return alarm_;
  }
  const std::uint32_t deadline = CONodeNextDeadline(const_cast<CO_NODE*>(&node));
  return deadline == std::numeric_limits<std::uint32_t>::max() ? never : now_ + deadline;
}

void Fixture::wake_up(Where at) {
  alarm_ = never;
  call(
      [this] {
        COTmrService(&node.Tmr);
        COTmrProcess(&node.Tmr);
        process_frames();
      },
      at);
}

void Fixture::run_until(std::uint64_t end, Where at) {
  unsigned calls_at_this_tick = 0;
  for (std::uint64_t wake = next_wake(); wake <= end; wake = next_wake()) {
    calls_at_this_tick = wake > now_ ? 0 : calls_at_this_tick + 1;
    if (calls_at_this_tick > patience) {
      ADD_FAIL_CHECK_AT(at.file, at.line, "the timer never finds rest");
      break;
    }
    now_ = std::max(now_, wake);
    wake_up(at);
  }
  now_ = end;
}

void Fixture::after(Time time, Where at) {
  began_ = now_;
  run_until(now_ + ticks(time), at);
}

void Fixture::jump(Time time, Where at) {
  began_ = now_;
  now_ += ticks(time);
  wake_up(at);
}

void Fixture::idle(Time time) {
  began_ = now_;
  now_ += ticks(time);
}

void Fixture::elapse_only(Time time, std::int16_t elapsed, Where at) {
  idle(time);
  call(
      [&] {
        const std::int16_t result = COTmrService(&node.Tmr);
        const OutsideStack outside;
        CHECK(result == elapsed);
      },
      at);
}

}  // namespace test
