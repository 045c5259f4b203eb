// SPDX-License-Identifier: Apache-2.0
/// \file node.hpp
/// A CANopen node with its memory, on drivers of a host.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "co_core.h"
#include "host/host.hpp"
#include "host/table.hpp"

namespace lexican {

class Node {
 public:
  /// Called for every frame that the node receives or sends.
  using Observer = std::function<void(bool received, const CO_IF_FRM& frame)>;

  struct Setup {
    std::uint8_t node_id;
    Can can;
    Timer timer;
    Table dictionary;
    Observer observer = {};
    bool observes_all = false;  // the observer is also called for frames that the node does not receive
    Errors errors = {};
    Memory memory = {};  // byte-writable; without it nothing is stored
    const CO_CALLBACKS* callbacks = nullptr;
    void* user = nullptr;  // of the callbacks
  };

  static constexpr std::uint32_t ticks_per_second = second;

  /// The drivers' contexts and the dictionary must outlive the node.
  explicit Node(Setup setup);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Processes received frames and expired timers. Returns false if no frame was received or sent.
  bool process();

  /// Returns the time until process() has to be called again, if no frame arrives before.
  Micros due_in();
  /// Returns true if process() has no work until a frame arrives.
  bool is_idle() { return CONodeNextDeadline(&node_) == UINT32_MAX; }

  /// \name Implementations of COLssLoad() and COLssStore(). The callbacks have no node argument; they use the node that
  /// is being created or processed.
  /// \{
  static CO_ERR load_lss(std::uint32_t* bit_rate, std::uint8_t* node_id);
  static CO_ERR store_lss(std::uint32_t bit_rate, std::uint8_t node_id);
  /// \}

  /// Sets the result of CONodeGetUser().
  void set_user(void* user) { extension_.User = user; }
  /// Sets a function that is called for each frame that the node receives, before the node processes it; empty: none.
  void set_receiver(std::function<void(const CO_IF_FRM&)> receiver) { tap_.receiver = std::move(receiver); }

  CO_NODE& stack() { return node_; }
  const CO_NODE& stack() const { return node_; }
  /// Returns the last error of the node and clears it.
  CO_ERR error() { return CONodeGetErr(&node_); }
  /// Returns the last error as text (name, object and meaning, and the fault of the dictionary, if any) and clears it.
  /// Empty: none.
  std::string error_text();
  CO_NODE_COUNTERS counters() const { return CONodeGetCounters(&node_); }

 private:
  /// CAN driver of the node: forwards all calls and reports the frames to the observer.
  struct Tap {
    Can can;
    Observer observer;
    bool observes_all;
    std::function<void(const CO_IF_FRM&)> receiver = {};
    bool failing = false;  // the last frame could not be sent because of an error
    static const CO_IF_CAN_DRV_EX driver;
    static const Can& can_of(void* tap);
    static void report_frame(void* tap, bool received, const CO_IF_FRM& frame);
  };

  static Node* active_node_;  // node that is being created or processed, for load_lss() and store_lss(); null: none

  Tap tap_;
  CO_NODE_EXT extension_{};
  CO_TMR_MEM timer_[1]{};  // for the application
  std::uint8_t sdo_buffer_[CO_SSDO_N * CO_SDO_BUF_BYTE]{};
  CO_NODE node_{};
};

}  // namespace lexican
