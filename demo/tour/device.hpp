// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// The clock that the master uses: in the same program, or elsewhere on the bus.
#pragma once

#include <cstdint>

#include "host/node.hpp"

namespace lexican::demo {

/// Differences between the clocks that the tour has to consider.
struct DeviceTraits {
  std::uint32_t picture_width;   // pixels
  std::uint32_t picture_height;  // pixels
  bool can_lose_power;           // lose_power() works and keeps the stored values
  unsigned timeout_factor;       // factor of all time-outs

  /// Returns the size in bytes: red, green and blue of each pixel.
  constexpr std::uint32_t picture_size() const { return picture_width * picture_height * 3; }
};

class Device {
 public:
  virtual ~Device() = default;

  virtual const DeviceTraits& traits() const = 0;

  /// Starts the device. Returns false if that fails.
  virtual bool start() = 0;
  /// Simulates a power failure: only stored values remain. start() must be called again.
  virtual void lose_power() = 0;
  /// Returns its node-ID; no_node_id: it waits for the LSS master.
  virtual std::uint8_t node_id() const = 0;
  /// Returns the node to run in the master's loop; null: the device runs elsewhere.
  virtual Node* node_in_loop() = 0;
};

}  // namespace lexican::demo
