// SPDX-License-Identifier: Apache-2.0
/// \file linux_timer.hpp
/// Timer driver for Linux: CLOCK_MONOTONIC in ticks of any frequency, and time-outs for poll() until the next deadline.
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
/// are always computed from the nanoseconds since Init, so no frequency drifts. Time-outs are rounded up: a wait never
/// ends before its tick, and no loop polls without waiting in the last fraction of a tick.
/// Instead of using a time-out, a loop can poll fd(), a timerfd that becomes readable at the alarm of the node.
///
/// Context: one thread. Owner: the caller; must outlive the node.
#ifndef CO_DRIVERS_LINUX_TIMER_HPP_
#define CO_DRIVERS_LINUX_TIMER_HPP_

#include <time.h>

#include <cstdint>

#include "co_timer_linux.h"

namespace co {

/// Returns the number of complete ticks in \a ns; exact as long as the result fits in 64 bits.
std::uint64_t ticks_from_ns(std::uint64_t ns, std::uint32_t frequency);
/// Returns the first nanosecond of a tick; \a frequency > 0.
std::uint64_t ns_from_ticks(std::uint64_t ticks, std::uint32_t frequency);
/// Returns CLOCK_MONOTONIC in nanoseconds.
std::uint64_t monotonic_ns();

/// The timer of a node: the context of LinuxTimerDriver. Not copyable: it owns a file descriptor.
class LinuxTimer {
 public:
  using Clock = std::uint64_t (*)();                  ///< function that returns a time in nanoseconds
  static constexpr std::uint32_t never = UINT32_MAX;  ///< no alarm; the value that CONodeNextDeadline() returns

  /// Constructs a timer whose tick stays 0 until start(). \a clock: returns nanoseconds since any epoch; must never
  /// decrease.
  explicit LinuxTimer(Clock clock = monotonic_ns);
  /// Closes the timerfd. The node must not use the timer any more.
  ~LinuxTimer();
  LinuxTimer(const LinuxTimer&) = delete;
  LinuxTimer& operator=(const LinuxTimer&) = delete;

  /// Starts at tick 0, without alarm. Called by the node. \a frequency: ticks per second; 0: the clock does not
  /// advance.
  void start(std::uint32_t frequency);
  /// Returns the ticks since start(); they wrap at 2^32.
  std::uint32_t now() const { return static_cast<std::uint32_t>(elapsed()); }

  /// Sets the alarm \a ticks from now; 0: no alarm. Replaces the previous alarm.
  void set_alarm(std::uint32_t ticks);
  /// Returns the ticks until the alarm, 0 once it has expired (until it is replaced); never if none is set.
  std::uint32_t until_alarm() const;

  /// Returns the time to wait until \a ticks from now have passed: nanoseconds; UINT64_MAX for never.
  std::uint64_t wait_ns(std::uint32_t ticks) const;
  /// Returns the time-out for poll() and epoll_wait(): milliseconds, at most INT_MAX; -1 (no time-out) for never.
  int poll_timeout(std::uint32_t ticks) const;
  /// Returns the time-out for ppoll() and pselect() in \a storage, or null (no time-out) for never.
  const timespec* ppoll_timeout(std::uint32_t ticks, timespec& storage) const;

  /// Returns a timerfd that becomes readable at the alarm and stays readable until the next one is set; -1 and errno if
  /// it cannot be created. The timer owns the descriptor.
  int fd();

 private:
  std::uint64_t elapsed() const;
  void arm() const;

  Clock clock_;
  std::uint64_t origin_ = 0;    // clock at the start, ns
  std::uint64_t deadline_ = 0;  // ticks since the start
  std::uint32_t frequency_ = 0;
  bool armed_ = false;
  int fd_ = -1;
};

/// The driver; its context is a LinuxTimer.
inline constexpr const CO_IF_TIMER_DRV_EX& LinuxTimerDriver = COLinuxTimerDriver;

}  // namespace co

#endif
