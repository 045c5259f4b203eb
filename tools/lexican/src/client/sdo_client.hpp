// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client.hpp
/// Synchronous access to the stack's SDO client: each call returns when the transfer has ended. [301:7.2.4]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "client/progress.hpp"
#include "client/values.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"

namespace lexican {

constexpr std::uint8_t no_sdo = 1;  ///< server of an SDO client that is not used

/// Dictionary of a node with an SDO client and the mandatory objects. [301:7.5.1, 7.5.2.34]
class ClientDictionary {
 public:
  /// \a server: node-ID of the server, reached by its default SDO.
  explicit ClientDictionary(std::uint8_t server);
  /// Returns a reference to the dictionary, which must outlive the node.
  Table table() { return {objects_.data(), static_cast<std::uint16_t>(objects_.size())}; }

 private:
  std::array<CO_OBJ, 11> objects_;
};

/// Result of a transfer.
struct Transfer {
  Bytes data;               // upload: the bytes read
  std::uint32_t code = 0;   // abort code of either side; 0: none
  std::string fault;        // reason why it could not be started; empty: it was started
  bool is_refused = false;  // the server has sent the abort code

  /// Returns true if the server has not answered in time. A server can also abort with the code of our time-out.
  bool is_unanswered() const { return code == CO_SDO_ERR_TIMEOUT && !is_refused; }
  bool done() const { return code == 0 && fault.empty(); }
  /// Returns the result as text.
  std::string outcome() const;
};

class SdoClient {
 public:
  /// Objects up to this size are read without block transfer: expedited or segmented.
  static constexpr std::uint32_t small = CO_CSDO_BLOCK > 0 ? CO_CSDO_BLOCK - 1U : 28U;

  struct Options {
    std::uint32_t capacity = small;              // upload: largest size of the object, bytes
    std::uint32_t timeout = 1000;                // ms, for each answer of the server; 0: no time-out
    std::function<void(const Amount&)> watch{};  // called with the progress of the transfer
  };

  /// Uses the first client of \a node, which must be one of \a loop. Both must outlive this object. \a usual: default
  /// options.
  SdoClient(Node& node, Loop& loop, Options usual);
  SdoClient(Node& node, Loop& loop) : SdoClient(node, loop, Options()) {}
  SdoClient(const SdoClient&) = delete;
  SdoClient& operator=(const SdoClient&) = delete;

  /// Transfers an object. An interruption of the program cancels it, with the abort code CO_SDO_ERR_TOS_LOCAL.
  Transfer upload(std::uint16_t index, std::uint8_t sub, const Options& options);
  Transfer upload(std::uint16_t index, std::uint8_t sub) { return upload(index, sub, usual_); }
  /// No bytes empty a string or a domain.
  Transfer download(std::uint16_t index, std::uint8_t sub, Bytes data, const Options& options);
  Transfer download(std::uint16_t index, std::uint8_t sub, Bytes data) {
    return download(index, sub, std::move(data), usual_);
  }

  const Options& usual() const { return usual_; }

 private:
  static void note_end(CO_CSDO* client, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void begin(CO_CSDO& client, std::uint16_t index, std::uint8_t sub);
  Transfer wait_for_end(CO_CSDO& client, const Options& options);

  Node& node_;
  Loop& loop_;
  Options usual_;
  bool ended_ = false;
  std::optional<std::uint32_t> refusal_;  // abort code that the server has sent in the last transfer
  std::uint32_t code_ = 0;                // result of the last transfer
};

/// A node of the stack as the SDO client of one device.
class DeviceClient {
 public:
  /// \a host must outlive it. \a server: node-ID of the device. \a observer: see Node::Setup; called for all frames.
  DeviceClient(Host& host, std::uint8_t server, Node::Observer observer = {})
      : dictionary_(server),
        node_({server == 127 ? std::uint8_t{126} : std::uint8_t{127}, host.master_can(), host.master_timer(),
               dictionary_.table(), std::move(observer), true}),
        loop_(host, {&node_}),
        sdo_(node_, loop_) {
    CONodeStart(&node_.stack());
  }
  ~DeviceClient() { loop_.flush(flush_time); }
  DeviceClient(const DeviceClient&) = delete;
  DeviceClient& operator=(const DeviceClient&) = delete;

  SdoClient& sdo() { return sdo_; }

 private:
  ClientDictionary dictionary_;
  Node node_;
  Loop loop_;
  SdoClient sdo_;
};

}  // namespace lexican
