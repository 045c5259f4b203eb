// SPDX-License-Identifier: Apache-2.0
/// \file linux_timer.hpp
/// The timer of a node on Linux: CLOCK_MONOTONIC in ticks of any frequency, and the waiting until something is due.
///
///     co::LinuxTimer timer;
///     ext.Timer = &co::LinuxTimerDriver;  ext.TimerCtx = &timer;  // CO_NODE_EXT
///     for (;;) {
///       CONodeProcess(&node);
///       COTmrService(&node.Tmr);
///       COTmrProcess(&node.Tmr);
///       pollfd wait{can.fd(), POLLIN, 0};
///       poll(&wait, 1, timer.poll_timeout(CONodeNextDeadline(&node)));
///     }
///
/// Units: ticks of the frequency given at Init (CO_NODE_SPEC.TmrFreq), starting at 0 there and wrapping at 2^32. They
/// are always computed from the nanoseconds since Init, so that no frequency drifts. Time-outs are rounded up: a wait
/// never ends before its tick, and no loop spins in the last fraction of one.
/// Instead of a time-out, a loop can wait for fd(), a timerfd that becomes readable at the alarm of the node.
///
/// Context: one thread. Owner: the caller; must outlive the node.
#ifndef CO_DRIVERS_LINUX_TIMER_HPP_
#define CO_DRIVERS_LINUX_TIMER_HPP_

#include <time.h>

#include <cstdint>

#include "co_timer_linux.h"

namespace co {

/// Ticks that are over after \a ns; exact as long as the result fits in 64 bits.
std::uint64_t ticks_from_ns(std::uint64_t ns, std::uint32_t frequency);
/// The first nanosecond of a tick; \a frequency > 0.
std::uint64_t ns_from_ticks(std::uint64_t ticks, std::uint32_t frequency);
/// CLOCK_MONOTONIC.
std::uint64_t monotonic_ns();

class LinuxTimer {
 public:
  using Clock = std::uint64_t (*)();
  static constexpr std::uint32_t never = UINT32_MAX;  ///< as CONodeNextDeadline() says it

  /// \a clock: nanoseconds since any moment, never going back.
  explicit LinuxTimer(Clock clock = monotonic_ns);
  ~LinuxTimer();
  LinuxTimer(const LinuxTimer&) = delete;
  LinuxTimer& operator=(const LinuxTimer&) = delete;

  /// Starts at tick 0. \a frequency: ticks per second; 0: the clock stands still.
  void start(std::uint32_t frequency);
  std::uint32_t now() const { return static_cast<std::uint32_t>(elapsed()); }

  /// \a ticks from now; 0: no alarm. Replaces the alarm set before.
  void set_alarm(std::uint32_t ticks);
  /// Ticks until the alarm, 0: it has come; never: none is set. It stays until it is replaced.
  std::uint32_t until_alarm() const;

  /// How long to wait until \a ticks from now are over: nanoseconds; UINT64_MAX for never.
  std::uint64_t wait_ns(std::uint32_t ticks) const;
  /// The same for poll() and epoll_wait(): milliseconds, at most INT_MAX; -1 (wait for ever) for never.
  int poll_timeout(std::uint32_t ticks) const;
  /// The same for ppoll() and pselect(): \a storage, or null (wait for ever) for never.
  const timespec* ppoll_timeout(std::uint32_t ticks, timespec& storage) const;

  /// A timerfd that is readable from the alarm on until the next one is set; -1 (errno) if there can be none.
  /// Belongs to the timer.
  int fd();

 private:
  std::uint64_t elapsed() const;
  void arm() const;

  Clock clock_;
  std::uint64_t origin_ = 0;    // of the clock, ns
  std::uint64_t deadline_ = 0;  // ticks since the start
  std::uint32_t frequency_ = 0;
  bool armed_ = false;
  int fd_ = -1;
};

/// The driver; its context is a LinuxTimer.
inline constexpr const CO_IF_TIMER_DRV_EX& LinuxTimerDriver = COLinuxTimerDriver;

}  // namespace co

#endif
