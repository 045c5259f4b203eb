// SPDX-License-Identifier: Apache-2.0
/// \file master.hpp
/// A small CANopen master in the same thread as the device: while it waits, the device runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linux_node/clock.hpp"
#include "linux_node/host.hpp"

namespace demo {

/// NMT commands. [301:7.2.8.3.1.1]
enum class Nmt : std::uint8_t { start = 1, stop = 2, enter_pre_operational = 128, reset_node = 129 };

/// State bytes of error control. [301:7.2.8.3.2]
enum class State : std::uint8_t { boot_up = 0, stopped = 4, operational = 5, pre_operational = 127 };

class Master {
 public:
  using Match = std::function<bool(const CO_IF_FRM&)>;

  /// Goes on the bus. \a node_id: the node to talk to; \a host and \a device must outlive the master.
  Master(Host& host, Clock& device, std::uint8_t node_id);
  ~Master();
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;

  bool send(const CO_IF_FRM& frame);
  /// The next frame that matches; others are thrown away. Nothing if none arrives in time, or after an interruption.
  std::optional<CO_IF_FRM> await(const Match& match, Micros timeout);

  bool command(Nmt command);
  /// Waits for a boot-up or heartbeat message with this state.
  bool await_state(State state, Micros timeout);

  std::uint8_t node_id() const { return node_id_; }
  Micros now() { return host_.now(); }
  bool interrupted() { return host_.interrupted(); }

 private:
  std::optional<CO_IF_FRM> next_match(const Match& match);

  Host& host_;
  Clock& device_;
  Can can_;
  std::uint8_t node_id_;
};

}  // namespace demo
