// SPDX-License-Identifier: Apache-2.0
/// \file clock.hpp
/// The demo device: a clock whose time of day, texts and picture can be read and written over CANopen.
///
/// A dictionary names its variables by address, so a program has one clock.
#pragma once

#include <cstdint>
#include <functional>

#include "co_core.h"
#include "linux_node/host.hpp"
#include "trace/decode.hpp"

namespace demo {

constexpr std::uint32_t clock_product_code = 0xC10C;
constexpr std::uint32_t clock_serial_number = 1;
constexpr char clock_name[] = "Lexican demo clock";
constexpr std::uint32_t picture_size = 300;  // bytes

/// What the network sees under 2100h.
struct TimeOfDay {
  std::uint8_t hour;    // 0…23
  std::uint8_t minute;  // 0…59
  std::uint8_t second;  // 0…59
};

/// Names of the objects of the clock, for the trace.
const trace::Names& clock_object_names();

/// The clock as a CANopen node. Starts at 00:00:00.
class Clock {
 public:
  /// Called for every frame that the node takes from the bus (received) or puts on it.
  using Observer = std::function<void(bool received, const CO_IF_FRM& frame)>;

  /// The drivers' contexts must outlive the clock.
  Clock(std::uint8_t node_id, Can can, Timer timer, Observer observer);
  ~Clock();
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  /// Sends the boot-up message. Returns false if the node could not be initialised; see error().
  bool start();

  /// Works off the frames that have arrived and the timers that have elapsed.
  void process();

  /// Time until process() has something to do, if no frame arrives before.
  Micros due_in();

  /// The last error of the node, which is thereby cleared.
  CO_ERR error() { return CONodeGetErr(&node_); }

  CO_NODE_COUNTERS counters() const { return CONodeGetCounters(&node_); }
  static TimeOfDay time();

 private:
  static constexpr std::uint32_t ticks_per_second = second;

  /// The node's CAN driver: passes everything on and shows it to the observer.
  struct Tap {
    Can can;
    Observer observer;
    bool failing;  // the last frame could not be sent because of an error
    static const CO_IF_CAN_DRV_EX driver;
    static const Can& to(void* tap);
  };

  Tap tap_;
  CO_NODE_EXT extension_{};
  CO_TMR_MEM timer_[1]{};
  CO_NODE node_{};
};

}  // namespace demo
