// SPDX-License-Identifier: Apache-2.0
/// \file sdo_pair_foreign.hpp
/// Peers of block transfers that are none of ours, on a virtual bus, typed from the standard: blocks of any size, and
/// no more cleverness than the standard asks for. [301:7.2.4.3.9-16]
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "block_client.hpp"
#include "network.hpp"

namespace test {

/// A server of one object, whatever its index. Its answers have to be fetched by work() and pass().
class ForeignServer {
 public:
  ForeignServer(Line& line, std::uint8_t node_id, std::uint8_t blksize);

  /// Serves the frames that have come. False: none.
  bool work();
  /// Time has passed. In the middle of a block, silence is answered with the last good segment. After two seconds of
  /// it the server gives up.
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
  std::uint8_t blksize_;  // of downloads
  State state_ = State::idle;
  Milliseconds silence_{0};
  unsigned reminders_ = 0;
  Bytes data_;                  // so far
  std::uint32_t size_ = 0;      // announced
  std::uint8_t good_ = 0;       // segments of the block
  std::uint8_t last_ = 0;       // command of the last segment of all
  std::size_t position_ = 0;    // of an upload, acknowledged
  unsigned sent_ = 0;           // segments of the block
  std::uint8_t asked_for_ = 0;  // blksize of uploads
};

/// A client that asks for blocks of a certain size. It gives up after a second without an answer.
class ForeignClient {
 public:
  ForeignClient(World& world, Line& line, std::uint8_t node_id, std::uint8_t blksize);

  /// Return the abort code of either side, or 0.
  std::uint32_t upload(std::uint16_t index);
  std::uint32_t download(std::uint16_t index, const Bytes& data);

  Bytes data;  ///< uploaded

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
