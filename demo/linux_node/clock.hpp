// SPDX-License-Identifier: Apache-2.0
/// \file clock.hpp
/// The demo device as a node of this program. TPDO1 transmits the time when it changes, RPDO1 sets it; an invalid time
/// raises an emergency. The clock stores station name and time zone on "save" (1010h), and the node-ID configured by
/// LSS.
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

namespace lexican::demo {

constexpr DeviceTraits clock_traits = {192, 128, true, 1};

constexpr std::uint32_t picture_size = clock_traits.picture_size();

/// Returns a serial number computed from a text, 1 or above.
std::uint32_t serial_number_from(const std::string& text);

/// The clock as a CANopen node. Its time starts at 00:00:00.
class Clock : public Device {
 public:
  /// \a node_id: used unless the memory holds one; no_node_id: the clock waits for the LSS master. \a memory:
  /// clock_memory_size bytes, byte-writable. \a serial: 1018h:4, which makes the LSS addresses of several clocks
  /// unique. The drivers' contexts must outlive the clock.
  Clock(std::uint8_t node_id, Can can, Timer timer, Node::Observer observer, Memory memory = {},
        std::uint32_t serial = clock_serial_number);

  const DeviceTraits& traits() const override { return clock_traits; }

  /// Starts the node, which sends its boot-up message as soon as it has a node-ID. Returns false if the node could not
  /// be initialised; see Node::error().
  bool start() override;

  /// Simulates a power failure: only stored values remain. start() must be called again; node() keeps its address.
  void lose_power() override;

  Node& node() { return *node_; }
  Node* node_in_loop() override { return &*node_; }
  /// Returns the active node-ID, possibly loaded from memory; no_node_id: none.
  std::uint8_t node_id() const override { return node_->stack().NodeId; }
  static TimeOfDay time() { return clock_time(); }

 private:
  std::vector<CO_OBJ> dictionary_;  // that of clock.xdd, with the serial number of this clock
  Node::Setup setup_;
  std::optional<Node> node_;
};

}  // namespace lexican::demo
