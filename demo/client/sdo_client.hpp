// SPDX-License-Identifier: Apache-2.0
/// \file sdo_client.hpp
/// The stack's SDO client for a program that wants to wait until a transfer has ended. [301:7.2.4]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "client/progress.hpp"
#include "client/values.hpp"
#include "host/loop.hpp"
#include "host/node.hpp"

namespace demo {

/// The dictionary of a node that has an SDO client, and besides it only what every node must have.
/// [301:7.5.1, 7.5.2.34]
class ClientDictionary {
 public:
  /// \a server: node-ID of the node to talk to, by its default SDO.
  explicit ClientDictionary(std::uint8_t server);
  /// The dictionary itself stays where it is.
  Table table() { return {objects_.data(), static_cast<std::uint16_t>(objects_.size())}; }

 private:
  std::array<CO_OBJ, 11> objects_;
};

/// How a transfer ended.
struct Transfer {
  Bytes data;              // upload: what was read
  std::uint32_t code = 0;  // abort code of either side; 0: none
  std::string fault;       // why it could not even begin; empty: it could

  bool done() const { return code == 0 && fault.empty(); }
  /// The end in words.
  std::string outcome() const;
};

class SdoClient {
 public:
  /// Objects below this size are read as they were before there was block transfer: expedited or segmented.
  static constexpr std::uint32_t small = CO_CSDO_BLOCK - 1;

  struct Options {
    std::uint32_t capacity = small;              // upload: bytes that the object may have
    std::uint32_t timeout = 1000;                // ms, for each answer of the server; 0: for ever
    std::function<void(const Amount&)> watch{};  // told how far the transfer is
  };

  /// Uses the first client of \a node, which runs in \a loop. Both must outlive this. \a usual: where none are given.
  SdoClient(Node& node, Loop& loop, Options usual);
  SdoClient(Node& node, Loop& loop) : SdoClient(node, loop, Options()) {}
  SdoClient(const SdoClient&) = delete;
  SdoClient& operator=(const SdoClient&) = delete;

  /// An interruption of the program cancels a transfer, with the abort code CO_SDO_ERR_TOS_LOCAL.
  Transfer upload(std::uint16_t index, std::uint8_t sub, const Options& options);
  Transfer upload(std::uint16_t index, std::uint8_t sub) { return upload(index, sub, usual_); }
  /// \a data must not be empty.
  Transfer download(std::uint16_t index, std::uint8_t sub, Bytes data, const Options& options);
  Transfer download(std::uint16_t index, std::uint8_t sub, Bytes data) {
    return download(index, sub, std::move(data), usual_);
  }

  const Options& usual() const { return usual_; }

 private:
  static void note_end(CO_CSDO* client, std::uint16_t index, std::uint8_t sub, std::uint32_t code);
  void begin();
  Transfer wait_for_end(CO_CSDO& client, const Options& options);

  Node& node_;
  Loop& loop_;
  Options usual_;
  bool ended_ = false;
  std::uint32_t code_ = 0;  // of the transfer that has ended
};

}  // namespace demo
