// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// The clock that a master talks to: in the same program, or anywhere else on the bus.
#pragma once

#include <cstdint>

#include "host/node.hpp"

namespace demo {

struct DeviceTraits {
  std::uint32_t picture_width;   // pixels
  std::uint32_t picture_height;  // pixels
  bool can_lose_power;           // at our command, and remembers what it has stored
  unsigned patience;             // how often the usual time it may take for everything

  /// Bytes: red, green and blue of each pixel.
  constexpr std::uint32_t picture_size() const { return picture_width * picture_height * 3; }
};

class Device {
 public:
  virtual ~Device() = default;

  virtual const DeviceTraits& traits() const = 0;

  /// Lets it boot, if it has a node-ID. Returns false if that cannot be.
  virtual bool start() = 0;
  /// Nothing is left but what it has stored. It has to be started again.
  virtual void lose_power() = 0;
  /// no_node_id: it waits for the LSS master.
  virtual std::uint8_t node_id() const = 0;
  /// Its node, where that has to run in the master's loop; null: it runs elsewhere.
  virtual Node* node_in_loop() = 0;
};

}  // namespace demo
