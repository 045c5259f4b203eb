// SPDX-License-Identifier: Apache-2.0
/// \file master.hpp
/// A small CANopen master with a separate node; while it waits, it also runs a device in the same program.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "client/lss_master.hpp"
#include "client/sdo_client.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"
#include "tour/device.hpp"

namespace lexican::demo {

/// NMT commands. [301:7.2.8.3.1.1]
enum class Nmt : std::uint8_t { start = 1, stop = 2, enter_pre_operational = 128, reset_node = 129 };

/// State bytes of error control. [301:7.2.8.3.2]
enum class State : std::uint8_t { boot_up = 0, stopped = 4, operational = 5, pre_operational = 127 };

class Master {
 public:
  /// Starts the master's node on the bus. \a node_id: the remote node; \a host and \a device must outlive the master.
  /// \a observer: called for each frame.
  Master(Host& host, Device& device, std::uint8_t node_id, Node::Observer observer = {});

  bool command(Nmt command);
  /// Sends a frame unchanged. Returns false if the bus does not accept it.
  bool send(CO_IF_FRM frame);
  /// Waits for a boot-up or heartbeat message with this state, received since the last command.
  bool await_state(State state, Micros timeout);
  /// Waits for the next frame of an identifier, received since the last command or sent frame.
  std::optional<CO_IF_FRM> await_frame(std::uint32_t identifier, Micros timeout);
  /// Discards the frames received so far.
  void discard_received();

  SdoClient& sdo() { return sdo_; }
#if USE_LSS_MASTER
  LssMaster& lss() { return lss_; }
#endif
  Loop& loop() { return loop_; }
  CO_NODE_COUNTERS counters() const { return node_.counters(); }
  std::uint8_t node_id() const { return node_id_; }

 private:
  static std::vector<Node*> nodes(Device& device, Node& own);
  void record_frame(bool received, const CO_IF_FRM& frame);
  bool has_received_state(State state);
  std::optional<CO_IF_FRM> next_frame(std::uint32_t identifier);

  std::uint8_t node_id_;
  Node::Observer observer_;
  std::deque<State> states_;      // received states of the node, not yet checked
  std::deque<CO_IF_FRM> frames_;  // received PDO, SYNC and EMCY messages, not yet checked
  ClientDictionary dictionary_;
  Node node_;
  Loop loop_;
  SdoClient sdo_;
#if USE_LSS_MASTER
  LssMaster lss_{node_, loop_, {CO_LSSM_TIMEOUT_MS, 20}};  // for a slave in the same program
#endif
};

}  // namespace lexican::demo
