// SPDX-License-Identifier: Apache-2.0
/// \file disturbance.hpp
/// A CAN driver that disturbs what a node sends and receives on the driver below it.
#pragma once

#include <deque>
#include <functional>
#include <random>

#include "host/host.hpp"

namespace lexican::simulate {

class DisturbedCan {
 public:
  static constexpr unsigned most_flooding = 10000;  ///< frames per second: more than a bus of 1 Mbit/s carries

  double drop = 0;      ///< part of the frames that are lost, in both directions, 0 to 1
  double repeat = 0;    ///< part of the sent frames that are sent twice
  Micros delay = 0;     ///< of sent frames
  bool is_off = false;  ///< nothing is sent or received

  /// \a seed: of the random numbers. \a now: any clock.
  DisturbedCan(Can below, std::uint64_t seed, std::function<Micros()> now)
      : below_(below), random_(seed), now_(std::move(now)) {}
  DisturbedCan(const DisturbedCan&) = delete;
  DisturbedCan& operator=(const DisturbedCan&) = delete;

  Can can() { return {&driver, this}; }
  /// Sets functions that are called for each frame that the node receives or sends, and may change the sent one.
  /// They return false for a frame that is lost.
  void on_frame(std::function<bool(const CO_IF_FRM&)> received, std::function<bool(CO_IF_FRM&)> sent) {
    received_ = std::move(received);
    sent_ = std::move(sent);
  }
  /// Brings the controller into bus-off. \a time: until the automatic recovery; for_ever: until recover(), or until the
  /// node resets it. \a errors: error frames on the bus before it
  void enter_bus_off(Micros time, unsigned errors);
  void recover();
  /// Sends frames with this identifier. \a rate: frames per second, at most most_flooding; 0: none
  void flood(std::uint32_t identifier, unsigned rate);

  /// Sends the frames whose time has come.
  void process();
  /// Returns the time at which process() has to be called again.
  Micros due() const;

 private:
  struct Delayed {
    Micros time;
    CO_IF_FRM frame;
  };
  struct Flood {
    CO_IF_FRM frame;
    double interval;  ///< µs; 0: no frames
    double next;      ///< time of the next frame
  };

  static DisturbedCan& of(void* context) { return *static_cast<DisturbedCan*>(context); }
  bool happens(double part) { return part > 0 && static_cast<double>(random_() >> 11) * 0x1p-53 < part; }
  bool is_bus_off() const { return bus_off_end_ != 0; }
  std::int16_t read(CO_IF_FRM* frame);
  std::int16_t send(CO_IF_FRM frame);
  std::int16_t pass(const CO_IF_FRM& frame) { return below_.driver->Send(below_.context, &frame); }
  void send_flood();

  static const CO_IF_CAN_DRV_EX driver;

  Can below_;
  std::mt19937_64 random_;
  std::function<Micros()> now_;
  std::function<bool(const CO_IF_FRM&)> received_;
  std::function<bool(CO_IF_FRM&)> sent_;
  std::deque<Delayed> delayed_;
  std::deque<std::uint32_t> events_;  ///< of the controller: classes of the error frames that the node reads
  Micros bus_off_end_ = 0;            ///< 0: it is not in bus-off
  unsigned errors_ = 0;               ///< error frames that have to be sent
  Flood flood_{};
};

}  // namespace lexican::simulate
