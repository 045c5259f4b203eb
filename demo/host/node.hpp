// SPDX-License-Identifier: Apache-2.0
/// \file node.hpp
/// A CANopen node with all the memory that it needs, on drivers of a host.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "co_core.h"
#include "host/host.hpp"
#include "host/table.hpp"

namespace demo {

class Node {
 public:
  /// Called for every frame that the node takes from the bus (received) or puts on it.
  using Observer = std::function<void(bool received, const CO_IF_FRM& frame)>;

  struct Setup {
    std::uint8_t node_id;
    Can can;
    Timer timer;
    Table dictionary;
    Observer observer = {};
    bool hears_all = false;  // the observer gets the frames that are not for this node, too
    Errors errors = {};
    Memory memory = {};  // that can be written byte by byte; without it nothing is stored
  };

  static constexpr std::uint32_t ticks_per_second = second;

  /// The drivers' contexts and the dictionary must outlive the node.
  explicit Node(Setup setup);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Works off the frames that have arrived and the timers that have elapsed. Returns false if no frame went over the
  /// bus.
  bool process();

  /// Time until process() has something to do, if no frame arrives before.
  Micros due_in();
  /// Whether process() has nothing to do until a frame arrives.
  bool is_idle() { return CONodeNextDeadline(&node_) == UINT32_MAX; }

  /// \name What COLssLoad() and COLssStore() have to do. These do not say for which node they are called; it is the one
  /// that is being made or processed.
  /// \{
  static CO_ERR load_lss(std::uint32_t* bit_rate, std::uint8_t* node_id);
  static CO_ERR store_lss(std::uint32_t bit_rate, std::uint8_t node_id);
  /// \}

  /// For CONodeGetUser().
  void set_user(void* user) { extension_.User = user; }

  CO_NODE& stack() { return node_; }
  const CO_NODE& stack() const { return node_; }
  /// The last error of the node, which is thereby cleared.
  CO_ERR error() { return CONodeGetErr(&node_); }
  /// The last error in words: name, object and meaning, and the fault of the dictionary, if there is one. The error is
  /// thereby cleared. Empty: none.
  std::string error_text();
  CO_NODE_COUNTERS counters() const { return CONodeGetCounters(&node_); }

 private:
  /// The node's CAN driver: passes everything on and shows it to the observer.
  struct Tap {
    Can can;
    Observer observer;
    bool hears_all;
    bool failing = false;  // the last frame could not be sent because of an error
    static const CO_IF_CAN_DRV_EX driver;
    static const Can& to(void* tap);
    static void show(void* tap, bool received, const CO_IF_FRM& frame);
  };

  static Node* at_work_;  // null: none

  Tap tap_;
  CO_NODE_EXT extension_{};
  CO_TMR_MEM timer_[1]{};  // for the application
  std::uint8_t sdo_buffer_[CO_SSDO_N * CO_SDO_BUF_BYTE]{};
  CO_NODE node_{};
};

}  // namespace demo
