// SPDX-License-Identifier: Apache-2.0
/// \file clock.hpp
/// The demo device: a clock whose time of day, texts and picture can be read and written over CANopen. TPDO1 tells the
/// time when it changes, RPDO1 sets it; a time that no clock shows is an emergency. It keeps the name of its station
/// and its time zone when it is told to ("save" to 1010h), and the node-ID that LSS gives it.
///
/// A dictionary names its variables by address, so a program has one clock.
#pragma once

#include <cstdint>
#include <optional>

#include "host/node.hpp"
#include "trace/decode.hpp"

namespace demo {

constexpr std::uint32_t clock_product_code = 0xC10C;
constexpr std::uint32_t clock_serial_number = 1;
constexpr char clock_name[] = "Lexican demo clock";
constexpr std::uint32_t picture_width = 192;                                // pixels
constexpr std::uint32_t picture_height = 128;                               // pixels
constexpr std::uint32_t picture_size = picture_width * picture_height * 3;  // bytes: red, green and blue of each pixel

/// Bytes of memory that survive a loss of power.
constexpr std::uint32_t clock_memory_size = 256;

/// What the network sees under 2100h.
struct TimeOfDay {
  std::uint8_t hour;    // 0…23
  std::uint8_t minute;  // 0…59
  std::uint8_t second;  // 0…59
};

/// Names of the objects of the clock, for the trace.
const trace::Names& clock_object_names();
/// What its PDOs hold.
trace::Mappings clock_mappings();

/// The clock as a CANopen node. Starts at 00:00:00.
class Clock {
 public:
  /// \a node_id: unless the memory holds one; no_node_id: the clock waits for the LSS master. \a memory: of
  /// clock_memory_size bytes, that can be written byte by byte. The drivers' contexts must outlive the clock.
  Clock(std::uint8_t node_id, Can can, Timer timer, Node::Observer observer, Memory memory = {});

  /// Sends the boot-up message, as soon as there is a node-ID. Returns false if the node could not be initialised; see
  /// Node::error().
  bool start();

  /// Nothing is left but what is in the memory. The clock has to be started again; node() is at the same place.
  void lose_power();

  Node& node() { return *node_; }
  /// Also that which was stored; no_node_id: none.
  std::uint8_t node_id() { return node_->stack().NodeId; }
  static TimeOfDay time();

 private:
  Node::Setup setup_;
  std::optional<Node> node_;
};

}  // namespace demo
