// SPDX-License-Identifier: Apache-2.0
/// \file device.hpp
/// A simulated device: a node of the stack with the dictionary of a description, whose memory can be a file.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "co_nvm_ram.h"
#include "co_od.h"
#include "describe/description.hpp"
#include "file_nvm.hpp"
#include "host/node.hpp"
#include "simulate/dictionary.hpp"

namespace lexican::simulate {

struct DeviceSetup {
  std::uint8_t node_id = 1;  ///< 255: none, an LSS slave
  std::uint32_t serial = 0;  ///< of 1018h:04; 0: that of the description
  std::string storage;       ///< file of the non-volatile memory; empty: it ends with the program
  Can can;
  Timer timer;
};

class Device {
 public:
  /// \a file: the bytes of the description.
  Device(const describe::Description& description, const std::string& file, const DeviceSetup& setup);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Starts the node: its boot-up message is sent.
  /// \retval text  why it cannot run; empty: it runs
  std::string start();
  /// Returns what is wrong with the dictionary although the node runs; empty: nothing.
  const std::string& fault() const { return fault_; }
  Node& node() { return *node_; }
  bool has_node() const { return node_ != nullptr; }  ///< false within start() and power_cycle()
  Dictionary& dictionary() { return dictionary_; }
  const describe::Description& description() const { return description_; }

  /// Sets an object from inside the device, as its application does: access rights and limits of the bus do not count.
  /// A TPDO that maps it is sent, if its transmission type is event-driven.
  /// \retval false  there is no such object, or the value has another length
  bool set(std::uint16_t index, std::uint8_t sub_index, const Bytes& value) {
    return put(index, sub_index, value, true);
  }
  /// Does the same. \a is_event: the TPDOs are sent
  bool put(std::uint16_t index, std::uint8_t sub_index, const Bytes& value, bool is_event);
  /// Returns the value of an object; nothing: it is none, or longer than 8 bytes.
  std::optional<Bytes> get(std::uint16_t index, std::uint8_t sub_index);

  /// Holds TPDOs back during its lifetime. Then each one of which objects were set is sent once, with all new values.
  class Hold {
   public:
    /// \a device: has a node, and keeps it.
    explicit Hold(Device& device) : stack_(device.node_->stack()) { OD_lock(&stack_); }
    ~Hold() { OD_unlock(&stack_); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    CO_NODE& stack_;
  };

  /// Reports an error by EMCY; clear() reports that it has gone. \a code: EMCY error code, which also decides the bit
  /// of the error register (1001h). [301:7.2.7.1]
  void raise(std::uint16_t code);
  void clear();
  /// Resets the node as after a power cycle: values that are not stored get their defaults.
  void power_cycle();

  /// Events of the node since the last call.
  struct Events {
    bool was_reset;     ///< NMT reset, or power cycle
    bool is_separated;  ///< NMT stop, or no heartbeat or guarding any more
  };
  /// Sets a function that is called when all objects of an RPDO are written.
  void on_pdo(std::function<void()> function) { pdo_written_ = std::move(function); }
  Events take_events() { return std::exchange(events_, {}); }

 private:
  static const CO_CALLBACKS callbacks;
  void make_node();

  describe::Description description_;
  Dictionary dictionary_;
  DeviceSetup setup_;
  std::vector<std::uint8_t> memory_;
  CO_NVM_RAM ram_{};
  co::FileNvm file_;
  CO_EMCY_TBL emergency_{};
  std::string fault_;
  Events events_{};
  std::function<void()> pdo_written_;
  std::unique_ptr<Node> node_;
};

}  // namespace lexican::simulate
