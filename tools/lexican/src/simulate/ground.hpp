// SPDX-License-Identifier: Apache-2.0
/// \file ground.hpp
/// Bus and clock of simulated devices.
#pragma once

#include "host/host.hpp"

namespace lexican::simulate {

/// Bus and clock of the devices: real ones, or virtual ones.
class Ground {
 public:
  virtual ~Ground() = default;
  /// Returns the connection of a further device to the bus.
  virtual Can add_can() = 0;
  virtual Timer add_timer() = 0;
  /// Returns the time since any epoch.
  virtual Micros now() = 0;
  /// Returns whether error frames that a device sends reach the other participants, as on a simulated bus.
  virtual bool carries_error_frames() { return true; }
};

}  // namespace lexican::simulate
