// SPDX-License-Identifier: Apache-2.0
// Downloads to a server: segments, the end of every download, and blocks. [301:7.2.4.3.4, 7.2.4.3.9]
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/sdo/server.hpp"

namespace co::sdo::server {

Abort check_total(CO_SDO& channel, uint32_t total) {
  if (total > channel.Flow.Size) {
    return Abort::too_long;
  }
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  return has(channel.Flow, sized) ? access::compare_length(total, channel.Flow.Size)
                                  : access::check_length(*channel.Node, *channel.Obj, total);
}

Abort finish_download(CO_SDO& channel) {
  CO_ASSERT(!has(channel.Flow, whole) || channel.Obj != nullptr);
  const Abort abort =
      has(channel.Flow, whole) ? begin_data(channel, *channel.Obj, channel.Value, channel.Flow.Num) : Abort::none;
  return abort == Abort::none ? close(channel, Abort::none) : abort;
}

Abort download_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  const uint8_t command = request.Data[0];
  Abort abort = check_segment(channel, request);
  if (abort != Abort::none) {
    return abort;
  }
  const uint32_t left = channel.Flow.Size - channel.Flow.Num;
  const uint32_t n = has(channel.Flow, sized) ? wire::segment_length(command, left) : wire::segment_length(command);
  if (n > left) {
    return Abort::too_long;
  }
  if (wire::is_last_segment(command)) {
    set_total(channel, n);
  }
  CO_IF_FRM segment = request;  // a copy, because a type function may change its buffer
  abort = transfer_piece(channel, channel.Flow.Num, segment.Data + 1, n);
  channel.Flow.Num = channel.Read;
  answer.Data[0] = wire::download_segment_response(channel.Flow.Flags & toggled);
  channel.Flow.Flags ^= toggled;
  if (abort != Abort::none || !wire::is_last_segment(command)) {
    return abort;
  }
  abort = check_total(channel, channel.Flow.Num);
  return abort == Abort::none ? finish_download(channel) : abort;
}

}  // namespace co::sdo::server

// Block download. Segments are collected in the buffer, which is written to the object when it is full, and at the end
// of the transfer after the checks of length and CRC. [301:7.2.4.3.9-11]

#if USE_SDO_BLOCK

namespace co::sdo::server {
namespace {

// Returns the segments of the block that are left, for which the buffer has room; 0: it is full.
uint8_t room(const CO_SDO_FLOW& flow) { return static_cast<uint8_t>(flow.BlkSize - flow.Seq); }

Abort write_buffer(CO_SDO& channel, uint32_t n) {
  const bool opens = channel.Flow.Num == 0 && !has(channel.Flow, whole);
  Abort abort = opens ? begin_data(channel, *channel.Obj, channel.Value, 0) : Abort::none;
  channel.Flow.Fill = 0;
  if (abort == Abort::none) {
    abort = transfer_piece(channel, channel.Flow.Num, buffer_of(channel), n);
    channel.Flow.Num = channel.Read;
  }
  return abort;
}

// Writes the full buffer to the object.
Abort empty_buffer(CO_SDO& channel) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  add_to_crc(channel.Flow, buffer_of(channel));
  return write_buffer(channel, channel.Flow.Fill);
}

}  // namespace

// Errors are reported at the end of the block, because the client's further segments could otherwise be taken for
// commands.
bool store_in_block(CO_SDO& channel, const CO_IF_FRM& segment) {
  if (state_of(channel) != State::block_download) {
    return false;
  }
  CO_ASSERT(channel.Flow.Fill + wire::segment_bytes <= CO_SDO_BUF_BYTE);
  const Arrival arrival = receive_segment(channel.Flow, buffer_of(channel), segment);
  if (arrival == Arrival::last) {
    set_state(channel, State::block_download_end);
  }
  return arrival != Arrival::within;
}

Abort end_block(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  if (has(channel.Flow, too_long)) {
    return Abort::too_long;
  }
  Abort abort = Abort::none;
  uint8_t blksize = room(channel.Flow);
  if (blksize == 0) {
    blksize = CO_SDO_BUF_SEG;
    if (state_of(channel) == State::block_download) {
      abort = empty_buffer(channel);
    }
  }
  acknowledge(channel.Flow, blksize, answer);
  return abort;
}

Abort end_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  const uint32_t n = last_bytes(channel.Flow, request);
  Abort abort = check_total(channel, channel.Flow.Num + n);
  if (abort != Abort::none) {
    return abort;
  }
  if (!is_crc_right(channel.Flow, buffer_of(channel), request)) {
    return Abort::crc;
  }
  set_total(channel, n);
  abort = write_buffer(channel, n);
  answer.Data[0] = wire::confirm_block;
  return abort == Abort::none ? finish_download(channel) : abort;
}

void handle_silence(CO_SDO& channel) {
  const State state = state_of(channel);
  if (state != State::block_download && state != State::block_download_end) {
    return;
  }
  if (has(channel.Flow, too_long)) {
    abort_transfer(channel, Abort::too_long);
    return;
  }
  CO_IF_FRM frame = wire::empty_frame(channel.TxId);
  if (!repeat_acknowledge(channel.Flow, room(channel.Flow), frame)) {
    wire::put_head(frame, wire::accept_block, channel.Key);
    frame.Data[4] = channel.Flow.BlkSize;
  }
  transmit::send(*channel.Node, frame);
}

}  // namespace co::sdo::server

#endif
