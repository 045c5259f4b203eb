// SPDX-License-Identifier: Apache-2.0
/// \file virtual_clock.hpp
/// A clock that only the program advances, for tests and simulations: any number of nodes with a common time.
///
///     co::VirtualClock clock(0xFFFFFF00);                          // ticks at which it starts
///     co::VirtualTimer timer(clock, [&] { COTmrService(&node.Tmr); });
///     ext.Timer = &co::VirtualTimerDriver;  ext.TimerCtx = &timer; // CO_NODE_EXT
///     clock.advance(clock.ticks(std::chrono::milliseconds(100)));
///
/// Units: ticks of the frequency that the nodes set at their initialisation (CO_NODE_SPEC.TmrFreq); all nodes of a
/// clock must use the same one. The clock of the nodes wraps at 2^32, elapsed() does not.
/// advance() calls every alarm that is due meanwhile, in the order of time, then of the timers' creation, with the
/// clock at the tick of the alarm; so no alarm is early or late. advance_to_alarm() skips the time without alarms.
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

/// A clock for any number of timers. Not copyable: its timers refer to it.
class VirtualClock {
 public:
  static constexpr std::uint32_t never = UINT32_MAX;  ///< no alarm is set, see next_alarm()

  /// Constructs a clock without frequency. \a start: first value of now(), in ticks.
  explicit VirtualClock(std::uint32_t start = 0) : start_(start) {}
  VirtualClock(const VirtualClock&) = delete;
  VirtualClock& operator=(const VirtualClock&) = delete;

  /// Returns the time of the nodes in ticks; wraps at 2^32.
  std::uint32_t now() const { return start_ + static_cast<std::uint32_t>(elapsed_); }
  /// Returns the ticks since the construction.
  std::uint64_t elapsed() const { return elapsed_; }
  /// Returns elapsed() as time, rounded down; 0 before a node has set the frequency. A time source for
  /// VirtualBus::set_time().
  std::chrono::microseconds time() const;
  /// Converts a time to ticks, rounded up; 0 before a node has set the frequency.
  std::uint64_t ticks(std::chrono::microseconds time) const;
  /// Returns the ticks per second, 0: not yet set.
  std::uint32_t frequency() const { return frequency_; }
  /// Sets the ticks per second. Called by the nodes; a program without nodes may call it.
  void set_frequency(std::uint32_t frequency) { frequency_ = frequency; }

  /// Advances by \a ticks and calls the alarm functions that are due meanwhile, each with the clock at its tick.
  void advance(std::uint64_t ticks);
  /// Advances to the earliest alarm.
  /// \retval true   the clock was advanced
  /// \retval false  no alarm is set; the clock has not moved
  bool advance_to_alarm();
  /// Returns the ticks until the earliest alarm; never if none is set.
  std::uint32_t next_alarm() const;

 private:
  friend class VirtualTimer;
  VirtualTimer* earliest() const;

  std::vector<VirtualTimer*> timers_;  // in the order of creation
  std::uint64_t elapsed_ = 0;
  std::uint32_t start_;
  std::uint32_t frequency_ = 0;
};

/// The timer of one node: the context of VirtualTimerDriver.
class VirtualTimer {
 public:
  /// Adds a timer to \a clock, which must outlive it. \a on_alarm, which may be empty, is called on the tick of an
  /// alarm.
  explicit VirtualTimer(VirtualClock& clock, std::function<void()> on_alarm = {});
  /// Removes the timer from its clock. The node must not use it any more.
  ~VirtualTimer();
  VirtualTimer(const VirtualTimer&) = delete;
  VirtualTimer& operator=(const VirtualTimer&) = delete;

  /// Returns the clock given to the constructor.
  VirtualClock& clock() const { return clock_; }
  /// Sets the alarm \a ticks from now; 0: no alarm. Replaces the previous alarm.
  void set_alarm(std::uint32_t ticks);
  /// Returns true if an alarm is set and has not expired.
  bool armed() const { return armed_; }
  /// Returns the number of expired alarms.
  std::uint64_t alarms() const { return alarms_; }

 private:
  friend class VirtualClock;
  void expire();

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
