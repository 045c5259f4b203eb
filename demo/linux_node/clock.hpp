// SPDX-License-Identifier: Apache-2.0
/// \file clock.hpp
/// The demo device as a node of this program. TPDO1 tells the time when it changes, RPDO1 sets it; a time that no clock
/// shows is an emergency. It keeps the name of its station and its time zone when it is told to ("save" to 1010h), and
/// the node-ID that LSS gives it.
///
/// A program has one clock (clock/time_of_day.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clock/dictionary.hpp"

#include "host/node.hpp"
#include "tour/device.hpp"

namespace demo {

constexpr DeviceTraits clock_traits = {192, 128, true, 1};

constexpr std::uint32_t picture_size = clock_traits.picture_size();

/// Derives a serial number from a text, the same in every run; 1 or above.
std::uint32_t serial_number_from(const std::string& text);

/// The clock as a CANopen node. Starts at 00:00:00.
class Clock : public Device {
 public:
  /// \a node_id: unless the memory holds one; no_node_id: the clock waits for the LSS master. \a memory: of
  /// clock_memory_size bytes, that can be written byte by byte. \a serial: 1018h:4, which keeps the LSS addresses of
  /// several clocks apart. The drivers' contexts must outlive the clock.
  Clock(std::uint8_t node_id, Can can, Timer timer, Node::Observer observer, Memory memory = {},
        std::uint32_t serial = clock_serial_number);

  const DeviceTraits& traits() const override { return clock_traits; }

  /// Sends the boot-up message, as soon as there is a node-ID. Returns false if the node could not be initialised; see
  /// Node::error().
  bool start() override;

  /// Nothing is left but what is in the memory. The clock has to be started again; node() is at the same place.
  void lose_power() override;

  Node& node() { return *node_; }
  Node* node_in_loop() override { return &*node_; }
  /// Also that which was stored; no_node_id: none.
  std::uint8_t node_id() const override { return node_->stack().NodeId; }
  static TimeOfDay time() { return clock_time(); }

 private:
  std::vector<CO_OBJ> dictionary_;  // of clock.xdd, with the serial number of this clock
  Node::Setup setup_;
  std::optional<Node> node_;
};

}  // namespace demo
