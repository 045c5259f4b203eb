// SPDX-License-Identifier: Apache-2.0
/// \file sdo_pair_foreign.hpp
/// An SDO server and an SDO client for block transfers on a virtual bus that do not use the stack. They are derived
/// from the standard, support any blksize, and do only what the standard requires. [301:7.2.4.3.9-16]
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "block_client.hpp"
#include "network.hpp"

namespace test {

/// A server with one object, which it provides at every index. It responds in work() and pass().
class ForeignServer {
 public:
  ForeignServer(Line& line, std::uint8_t node_id, std::uint8_t blksize);

  /// Processes the received frames. Returns false if there was none.
  bool work();
  /// Lets time pass. Within a block download, the server acknowledges the last segment in order after 250 ms without a
  /// frame; after 2 s it aborts any transfer.
  void pass(Milliseconds time);

  Bytes object;

 private:
  enum class State { idle, receiving, received, ready, sending, sent };
  void serve(const CO_IF_FRM& request);
  void serve_command(const CO_IF_FRM& request);
  void answer(std::uint8_t command, const CO_IF_FRM& initiate, std::uint32_t value);
  void abort(const CO_IF_FRM& request, std::uint32_t code);
  void start_download(const CO_IF_FRM& request);
  void take_segment(const CO_IF_FRM& request);
  void acknowledge();
  void end_download(const CO_IF_FRM& request);
  void start_upload(const CO_IF_FRM& request);
  void send_block();
  void go_on(const CO_IF_FRM& request);

  co::VirtualBus::Port& port_;
  std::uint32_t answer_id_;
  std::uint8_t blksize_;  // blksize of downloads
  State state_ = State::idle;
  Milliseconds silence_{0};
  unsigned reminders_ = 0;
  Bytes data_;                  // received bytes of a download
  std::uint32_t size_ = 0;      // announced size of a download
  std::uint8_t good_ = 0;       // segments of the block received in order
  std::uint8_t last_ = 0;       // command byte of the last segment of a download
  std::size_t position_ = 0;    // acknowledged bytes of an upload
  unsigned sent_ = 0;           // sent segments of the block
  std::uint8_t asked_for_ = 0;  // blksize of uploads
};

/// A client that requests blocks of \a blksize segments. It aborts after 1 s without an answer.
class ForeignClient {
 public:
  ForeignClient(World& world, Line& line, std::uint8_t node_id, std::uint8_t blksize);

  /// Run a transfer. Return the abort code of either side; 0: success.
  std::uint32_t upload(std::uint16_t index);
  std::uint32_t download(std::uint16_t index, const Bytes& data);

  Bytes data;  ///< data of the last upload

 private:
  void send(std::uint8_t command, std::uint32_t first = 0, std::uint32_t second = 0);
  bool wait(Milliseconds time);
  std::uint32_t give_up(std::uint32_t code);
  std::uint32_t abort_code() const { return CO_GET_LONG(&answer_, 4); }
  bool is(std::uint8_t command) const { return answer_.Data[0] == command; }
  bool is_for_us() const { return (CO_GET_LONG(&answer_, 0) >> 8) == multiplexer_; }
  std::optional<std::uint32_t> receive_block(bool& last);
  std::uint32_t end_upload(std::uint32_t size);
  void send_block(const Bytes& all, std::size_t position, unsigned segments);
  std::uint32_t end_download(const Bytes& all);

  World& world_;
  co::VirtualBus::Port& port_;
  std::uint32_t request_id_;
  std::uint8_t blksize_;
  std::uint32_t multiplexer_ = 0;
  CO_IF_FRM answer_{};
};

}  // namespace test
