// SPDX-License-Identifier: Apache-2.0
/// \file virtual_clock.hpp
/// A clock that stands still until it is advanced, for tests and simulations: any number of nodes on one time.
///
///     co::VirtualClock clock(0xFFFFFF00);                          // ticks at which it starts
///     co::VirtualTimer timer(clock, [&] { COTmrService(&node.Tmr); });
///     ext.Timer = &co::VirtualTimerDriver;  ext.TimerCtx = &timer; // CO_NODE_EXT
///     clock.advance(clock.ticks(std::chrono::milliseconds(100)));
///
/// Units: ticks, of the frequency that the nodes give at their initialisation (CO_NODE_SPEC.TmrFreq); all nodes of a
/// clock must have the same. The clock of the nodes wraps at 2^32, elapsed() does not.
/// advance() stops at every alarm on its way, in the order of time and then of the timers' creation, with the clock on
/// the tick of the alarm; so nothing comes early or late. advance_to_alarm() leaps over the time in which nothing
/// happens.
///
/// Context: one thread. An alarm function may set alarms, create and destroy timers, and advance the clock.
/// Owner: the clock must outlive its timers, and these the nodes that use them.
#ifndef CO_DRIVERS_VIRTUAL_CLOCK_HPP_
#define CO_DRIVERS_VIRTUAL_CLOCK_HPP_

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "co_virtual_clock.h"

namespace co {

class VirtualTimer;

class VirtualClock {
 public:
  static constexpr std::uint32_t never = UINT32_MAX;

  explicit VirtualClock(std::uint32_t start = 0) : start_(start) {}
  VirtualClock(const VirtualClock&) = delete;
  VirtualClock& operator=(const VirtualClock&) = delete;

  /// The time as nodes see it.
  std::uint32_t now() const { return start_ + static_cast<std::uint32_t>(elapsed_); }
  /// Ticks since the construction.
  std::uint64_t elapsed() const { return elapsed_; }
  /// elapsed(), rounded down; 0 before a node has given the frequency. A time source for VirtualBus::set_time().
  std::chrono::microseconds time() const;
  /// A time in ticks, rounded up; 0 before a node has given the frequency.
  std::uint64_t ticks(std::chrono::microseconds time) const;
  /// Ticks per second, 0: not yet given.
  std::uint32_t frequency() const { return frequency_; }
  void set_frequency(std::uint32_t frequency) { frequency_ = frequency; }

  void advance(std::uint64_t ticks);
  /// Advances to the earliest alarm. Returns false, and the clock stands still, if none is set.
  bool advance_to_alarm();
  /// Ticks until the earliest alarm, never: none is set.
  std::uint32_t next_alarm() const;

 private:
  friend class VirtualTimer;
  VirtualTimer* earliest() const;

  std::vector<VirtualTimer*> timers_;  // by creation
  std::uint64_t elapsed_ = 0;
  std::uint32_t start_;
  std::uint32_t frequency_ = 0;
};

/// The timer of one node: the context of VirtualTimerDriver.
class VirtualTimer {
 public:
  /// \a on_alarm, which may be empty, is called on the tick of an alarm.
  explicit VirtualTimer(VirtualClock& clock, std::function<void()> on_alarm = {});
  ~VirtualTimer();
  VirtualTimer(const VirtualTimer&) = delete;
  VirtualTimer& operator=(const VirtualTimer&) = delete;

  VirtualClock& clock() const { return clock_; }
  /// \a ticks from now; 0: no alarm. Replaces the alarm set before.
  void set_alarm(std::uint32_t ticks);
  bool armed() const { return armed_; }
  /// Alarms that have come.
  std::uint64_t alarms() const { return alarms_; }

 private:
  friend class VirtualClock;
  void ring();

  VirtualClock& clock_;
  std::function<void()> on_alarm_;
  std::uint64_t deadline_ = 0;  // in VirtualClock::elapsed()
  std::uint64_t alarms_ = 0;
  bool armed_ = false;
};

/// The driver; its context is a VirtualTimer.
inline constexpr const CO_IF_TIMER_DRV_EX& VirtualTimerDriver = COVirtualTimerDriver;

}  // namespace co

#endif
