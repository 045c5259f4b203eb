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
  /// Sends the delayed frames whose time has come.
  void process();
  /// Returns the time at which process() has to be called again.
  Micros due() const { return delayed_.empty() ? for_ever : delayed_.front().time; }

 private:
  struct Delayed {
    Micros time;
    CO_IF_FRM frame;
  };

  static DisturbedCan& of(void* context) { return *static_cast<DisturbedCan*>(context); }
  bool happens(double part) { return part > 0 && static_cast<double>(random_() >> 11) * 0x1p-53 < part; }
  std::int16_t read(CO_IF_FRM* frame);
  std::int16_t send(const CO_IF_FRM& frame);
  std::int16_t pass(const CO_IF_FRM& frame) { return below_.driver->Send(below_.context, &frame); }

  static const CO_IF_CAN_DRV_EX driver;

  Can below_;
  std::mt19937_64 random_;
  std::function<Micros()> now_;
  std::deque<Delayed> delayed_;
};

}  // namespace lexican::simulate
