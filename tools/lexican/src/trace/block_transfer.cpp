// SPDX-License-Identifier: Apache-2.0
#include "trace/block_transfer.hpp"

namespace lexican::trace {
namespace {

constexpr std::uint8_t abort_transfer = 0x80;  // the only first byte that is not a segment within a sub-block
constexpr std::uint8_t sequence_number = 0x7F;

// Commands of block transfer in bits 7…5, and their sub-commands in bits 1…0. [301:7.2.4.3.8…7.2.4.3.16]
enum Request : unsigned { upload_request = 5, download_request = 6 };
enum Response : unsigned { download_response = 5, upload_response = 6 };
enum Step : unsigned { initiate = 0, end = 1, acknowledged = 2, start = 3 };

unsigned step(const CO_IF_FRM& frame) { return frame.Data[0] & 3u; }

}  // namespace

Role BlockTransfer::follow(Sender from, const CO_IF_FRM& frame) {
  if (open_ && from == sender_ && frame.Data[0] != abort_transfer) {
    return segment(frame);
  }
  return from == Sender::client ? request(frame) : response(frame);
}

Role BlockTransfer::segment(const CO_IF_FRM& frame) {
  const auto number = static_cast<std::uint8_t>(frame.Data[0] & sequence_number);
  const bool last = (frame.Data[0] & last_block_segment) != 0;
  last_ = last ? number : std::uint8_t{0};
  open_ = !last && number != block_size_;
  return last ? Role::last_segment : Role::segment;
}

Role BlockTransfer::request(const CO_IF_FRM& frame) {
  if (command_specifier(frame) == download_request) {
    if ((frame.Data[0] & end) == 0) {  // bit 0 is the sub-command; bit 1 of an initiate request is the size indicator s
      begin(Sender::client, 0);
    }
    return Role::command;
  }
  if (command_specifier(frame) == upload_request && step(frame) == initiate) {
    begin(Sender::server, frame.Data[4]);
  } else if (command_specifier(frame) != upload_request || step(frame) == end) {
    begin(Sender::none, 0);
  } else if (sender_ == Sender::server) {
    return step(frame) == start ? open(block_size_) : acknowledge(frame);
  }
  return Role::command;
}

Role BlockTransfer::response(const CO_IF_FRM& frame) {
  if (command_specifier(frame) == upload_response) {
    return Role::command;
  }
  if (command_specifier(frame) != download_response || step(frame) == end) {
    begin(Sender::none, 0);
  } else if (sender_ == Sender::client) {
    return step(frame) == initiate ? open(frame.Data[4]) : acknowledge(frame);
  }
  return Role::command;
}

Role BlockTransfer::acknowledge(const CO_IF_FRM& frame) {
  const bool all = last_ != 0 && frame.Data[1] == last_;
  if (all) {
    open_ = false;
    return Role::command;
  }
  open(frame.Data[2]);
  return Role::acknowledge;
}

void BlockTransfer::begin(Sender sender, std::uint8_t block_size) {
  sender_ = sender;
  open_ = false;
  block_size_ = block_size;
  last_ = 0;
}

Role BlockTransfer::open(std::uint8_t block_size) {
  open_ = true;
  block_size_ = block_size;
  last_ = 0;
  return Role::command;
}

}  // namespace lexican::trace
