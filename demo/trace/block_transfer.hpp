// SPDX-License-Identifier: Apache-2.0
/// \file block_transfer.hpp
/// Which frames are the segments of an SDO block transfer: their first byte alone cannot tell, it looks like any
/// command. [301:7.2.4.3.8…7.2.4.3.16]
#pragma once

#include <cstdint>

#include "co_if_can.h"

namespace demo::trace {

enum class Sender : std::uint8_t { nobody, client, server };

/// What a frame is in a block transfer.
enum class Role {
  command,       // none of the following, also any frame of another kind of transfer
  segment,       // but the last
  last_segment,  // the sender says so
  acknowledge,   // of segments, after which more will come
};

/// Follows the transfers of one SDO server.
class BlockTransfer {
 public:
  /// Takes note of the next frame between client and server.
  Role follow(Sender from, const CO_IF_FRM& frame);

 private:
  Role segment(const CO_IF_FRM& frame);
  Role request(const CO_IF_FRM& frame);
  Role response(const CO_IF_FRM& frame);
  Role acknowledge(const CO_IF_FRM& frame);
  void begin(Sender sender, std::uint8_t block_size);
  Role open(std::uint8_t block_size);

  Sender sender_ = Sender::nobody;  // of the segments
  bool open_ = false;               // within a sub-block
  std::uint8_t block_size_ = 0;     // segments of the sub-block
  std::uint8_t last_ = 0;           // sequence number of the last segment; 0: not yet seen
};

}  // namespace demo::trace
