// SPDX-License-Identifier: Apache-2.0
#include "linux_timer.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <climits>

namespace co {
namespace {

constexpr std::uint64_t ns_per_second = 1000000000;
constexpr std::uint64_t ns_per_ms = 1000000;

timespec timespec_from_ns(std::uint64_t ns) {
  timespec time{};
  time.tv_sec = static_cast<time_t>(ns / ns_per_second);
  time.tv_nsec = static_cast<long>(ns % ns_per_second);
  return time;
}

}  // namespace

// Converts whole seconds separately: the remainder is below 10^9 * 2^32 and fits into 64 bits.
std::uint64_t ticks_from_ns(std::uint64_t ns, std::uint32_t frequency) {
  return ns / ns_per_second * frequency + ns % ns_per_second * frequency / ns_per_second;
}

std::uint64_t ns_from_ticks(std::uint64_t ticks, std::uint32_t frequency) {
  const std::uint64_t rest = ticks % frequency * ns_per_second;
  return ticks / frequency * ns_per_second + (rest + frequency - 1) / frequency;
}

std::uint64_t monotonic_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * ns_per_second + static_cast<std::uint64_t>(time.tv_nsec);
}

LinuxTimer::LinuxTimer(Clock clock) : clock_(clock) {}

LinuxTimer::~LinuxTimer() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

void LinuxTimer::start(std::uint32_t frequency) {
  origin_ = clock_();
  frequency_ = frequency;
  set_alarm(0);
}

void LinuxTimer::set_alarm(std::uint32_t ticks) {
  armed_ = (ticks != 0) && (frequency_ != 0);
  deadline_ = elapsed() + ticks;
  arm();
}

std::uint32_t LinuxTimer::until_alarm() const {
  if (!armed_) {
    return never;
  }
  const std::uint64_t now = elapsed();
  return (deadline_ <= now) ? 0 : static_cast<std::uint32_t>(std::min<std::uint64_t>(deadline_ - now, never - 1));
}

std::uint64_t LinuxTimer::wait_ns(std::uint32_t ticks) const {
  if (ticks == 0) {
    return 0;
  }
  if (ticks == never || frequency_ == 0) {
    return UINT64_MAX;
  }
  // Computed from one reading of the clock. Its tick has already begun, so the wait is up to one tick shorter than
  // ticks.
  const std::uint64_t ns = clock_() - origin_;
  return ns_from_ticks(ticks_from_ns(ns, frequency_) + ticks, frequency_) - ns;
}

int LinuxTimer::poll_timeout(std::uint32_t ticks) const {
  const std::uint64_t ns = wait_ns(ticks);
  if (ns == UINT64_MAX) {
    return -1;
  }
  return static_cast<int>(std::min<std::uint64_t>((ns + ns_per_ms - 1) / ns_per_ms, INT_MAX));
}

const timespec* LinuxTimer::ppoll_timeout(std::uint32_t ticks, timespec& storage) const {
  const std::uint64_t ns = wait_ns(ticks);
  if (ns == UINT64_MAX) {
    return nullptr;
  }
  storage = timespec_from_ns(ns);
  return &storage;
}

int LinuxTimer::fd() {
  if (fd_ < 0) {
    fd_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    arm();
  }
  return fd_;
}

std::uint64_t LinuxTimer::elapsed() const { return ticks_from_ns(clock_() - origin_, frequency_); }

void LinuxTimer::arm() const {
  if (fd_ < 0) {
    return;
  }
  itimerspec alarm{};  // zero disarms, and makes the descriptor unreadable
  if (armed_) {
    const std::uint64_t due = ns_from_ticks(deadline_, frequency_);
    const std::uint64_t ns = clock_() - origin_;
    alarm.it_value = timespec_from_ns(due > ns ? due - ns : 1);  // zero would disarm
  }
  timerfd_settime(fd_, 0, &alarm, nullptr);
}

namespace {

LinuxTimer& timer(void* ctx) { return *static_cast<LinuxTimer*>(ctx); }

void init(void* ctx, std::uint32_t freq) { timer(ctx).start(freq); }
std::uint32_t now(void* ctx) { return timer(ctx).now(); }
void alarm(void* ctx, std::uint32_t ticks) { timer(ctx).set_alarm(ticks); }

}  // namespace

}  // namespace co

const CO_IF_TIMER_DRV_EX COLinuxTimerDriver = {co::init, co::now, co::alarm};
