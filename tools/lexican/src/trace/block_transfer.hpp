// SPDX-License-Identifier: Apache-2.0
/// \file block_transfer.hpp
/// Detects the segments of an SDO block transfer. It needs the frames before: the first byte of a segment may look like
/// any command. [301:7.2.4.3.8…7.2.4.3.16]
#pragma once

#include <cstdint>

#include "co_if_can.h"

namespace lexican::trace {

constexpr unsigned last_block_segment = 0x80;  // flag c of a segment

/// Returns the command specifier of an SDO frame that is not a segment of a block transfer.
inline unsigned command_specifier(const CO_IF_FRM& frame) { return frame.Data[0] >> 5; }

enum class Sender : std::uint8_t { none, client, server };

/// Role of a frame in a block transfer.
enum class Role {
  command,       // any other frame, also of another type of transfer
  segment,       // a segment, not the last one
  last_segment,  // a segment with the flag c
  acknowledge,   // confirms segments; more segments follow
};

/// State of the transfers of one SDO server.
class BlockTransfer {
 public:
  /// Processes the next frame between client and server, and returns its role.
  Role follow(Sender from, const CO_IF_FRM& frame);

 private:
  Role segment(const CO_IF_FRM& frame);
  Role request(const CO_IF_FRM& frame);
  Role response(const CO_IF_FRM& frame);
  Role acknowledge(const CO_IF_FRM& frame);
  void begin(Sender sender, std::uint8_t block_size);
  Role open(std::uint8_t block_size);

  Sender sender_ = Sender::none;  // sender of the segments; none: no block transfer
  bool open_ = false;             // within a sub-block
  std::uint8_t block_size_ = 0;   // segments of the sub-block
  std::uint8_t last_ = 0;         // sequence number of the last segment; 0: not yet seen
};

}  // namespace lexican::trace
