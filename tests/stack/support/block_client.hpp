// SPDX-License-Identifier: Apache-2.0
/// \file block_client.hpp
/// A client for SDO block transfers, derived from the standard, that recovers from lost frames as far as possible. It
/// computes the CRC separately from the stack, bit by bit. [301:7.2.4.3.9-16]
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "block.hpp"
#include "co_core.h"

namespace test {

class Fixture;
using Bytes = std::vector<std::uint8_t>;

/// Line of a test, for failure reports.
struct Where {
  const char* file;
  int line;
};

/// Settings and faults. Frames are numbered from 0, separately for client and server.
struct BlockOptions {
  bool crc = true;                          ///< the client supports the CRC
  bool sized = true;                        ///< the client announces the size of a download
  std::vector<std::uint8_t> blksizes{127};  ///< requested blksizes of an upload, one per block, repeated
  std::uint8_t pst = 0;                     ///< protocol switch threshold of an upload
  std::set<unsigned> lost_requests{};       ///< numbers of the client's frames that are lost
  std::set<unsigned> doubled_requests{};    ///< numbers of the client's frames that are received twice
  std::set<unsigned> late_requests{};       ///< numbers of the client's frames that are received after the next one
  std::set<unsigned> lost_answers{};        ///< numbers of the server's frames that are lost
  std::uint32_t announced_more = 0;         ///< bytes that the announced size exceeds the data by, modulo 2^32
  std::uint16_t crc_error = 0;              ///< bits of the CRC that are inverted
};

struct BlockResult {
  /// 0: success; otherwise the abort code of either side. A client that receives no answer aborts with 0504 0000h.
  std::uint32_t abort = 0;
  Bytes data{};
  unsigned requests = 0;  ///< frames of the client
  unsigned answers = 0;   ///< frames of the server
  bool by_client = false;
};

class BlockClient {
 public:
  BlockClient(Fixture& node, const BlockOptions& options, Where at) : node_(node), options_(options), at_(at) {}
  BlockResult upload(std::uint16_t index, std::uint8_t sub);
  BlockResult download(std::uint16_t index, std::uint8_t sub, const Bytes& data);

 private:
  void send(const CO_IF_FRM& frm);
  void deliver(const CO_IF_FRM& frm);
  void collect();
  bool wait(unsigned slices);
  bool next(unsigned slices = 9);
  bool is(std::uint8_t command) const { return answer_.Data[0] == command; }
  bool give_up(std::uint32_t code);

  bool is_accepted();
  bool send_blocks(const Bytes& data);
  void send_block(const Bytes& data, std::size_t first, std::size_t end);
  bool end_download(const Bytes& data);

  std::uint8_t next_blksize();
  bool upload_blocks();
  bool receive_block();
  bool take_segment(std::uint8_t& good);
  bool end_upload();
  bool upload_ordinarily();

  Fixture& node_;
  const BlockOptions& options_;
  Where at_;
  CO_IF_FRM multiplexer_{};
  CO_IF_FRM answer_{};
  CO_IF_FRM acknowledge_{};
  std::deque<CO_IF_FRM> inbox_;
  std::deque<CO_IF_FRM> held_;
  std::size_t block_ = 0;
  std::uint8_t present_blksize_ = 0;
  unsigned silences_ = 0;
  bool last_ = false;
  bool has_crc_ = false;
  bool sized_ = false;
  std::uint32_t size_ = 0;
  BlockResult result_;
};

}  // namespace test
