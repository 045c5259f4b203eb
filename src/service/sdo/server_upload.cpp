// SPDX-License-Identifier: Apache-2.0
// Uploads from a server: segments and blocks. [301:7.2.4.3.7, 7.2.4.3.13]
#include "base/events.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/sdo/server.hpp"

namespace co::sdo::server {

Abort upload_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  Abort abort = check_segment(channel, request);
  if (abort != Abort::none) {
    return abort;
  }
  const uint32_t position = channel.Flow.Num;
  const uint32_t left = channel.Flow.Size - position;
  abort = transfer_piece(channel, position, answer.Data + 1, left < wire::segment_bytes ? left : wire::segment_bytes);
  if (abort != Abort::none) {
    return abort;
  }
  channel.Flow.Num = channel.Read;
  const bool last = channel.Flow.Num == channel.Flow.Size;
  answer.Data[0] = wire::segment(channel.Flow.Flags & toggled, channel.Flow.Num - position, last);
  channel.Flow.Flags ^= toggled;
  return last ? close(channel, Abort::none) : Abort::none;
}

}  // namespace co::sdo::server

// Block upload. The buffer holds a window of the object, which goes back when the client has lost segments. Segments
// are sent as the controller accepts them. [301:7.2.4.3.13-15]

#if USE_SDO_BLOCK

namespace co::sdo::server {
namespace {

constexpr uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

// Updates the CRC, which covers each byte once, even if it is sent again.
void add_sent_to_crc(CO_SDO& channel, uint32_t position) {
  if (channel.Read <= channel.Summed) {
    return;
  }
  const uint32_t from = channel.Summed - position;
  if (has(channel.Flow, crc)) {
    channel.Flow.Crc = wire::crc16(channel.Flow.Crc, buffer_of(channel) + from, channel.Flow.Fill - from);
  }
  channel.Summed = channel.Read;
}

// Pauses the transfer until the next call of CONodeProcess() or COTmrProcess().
void pause_transfer(CO_NODE& node) {
  node.Transmit.Paused = 1;
  node.Transmit.Burst = CO_SDO_BLOCK_PACE;
}

Abort load_window(CO_SDO& channel, uint32_t position) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  CO_ASSERT(position < channel.Flow.Size);
  const uint32_t n = smaller(CO_SDO_BUF_BYTE, channel.Flow.Size - position);
  __builtin_memset(buffer_of(channel), 0, n);  // clears bytes that the type may not fill
  const Abort abort = transfer_piece(channel, position, buffer_of(channel), n);
  if (has(channel.Flow, behind)) {
    channel.Flow.Fill = 0;
    pause_transfer(*channel.Node);
    return Abort::none;
  }
  channel.Flow.Fill = static_cast<uint16_t>(channel.Read - position);
  if (abort == Abort::none) {
    add_sent_to_crc(channel, position);
  }
  return abort;
}

// Returns whether the segment at the position is in the buffer, after reading it if necessary. Otherwise abort is the
// reason, if SDO is still allowed.
bool provide_segment(CO_SDO& channel, uint32_t position, Abort& abort) {
  if (channel.Read - position - 1 < channel.Flow.Fill || position >= channel.Flow.Size) {
    return true;
  }
  abort = load_window(channel, position);
  const bool is_there = abort == Abort::none && !has(channel.Flow, behind);
  clear(channel.Flow, behind);
  return is_there && event::is_allowed(*channel.Node, CO_SDO_ALLOWED);
}

// Fills a segment from the left bytes in the buffer.
void fill_segment(CO_IF_FRM& frame, const uint8_t* from, uint32_t left) {
  if (left >= wire::segment_bytes) {
    wire::copy_segment(frame.Data + 1, from);
  } else {
    wire::put_low(frame, 0);
    wire::put_high(frame, 0);
    wire::copy(frame.Data + 1, from, left);
  }
}

}  // namespace

Abort send_segments(CO_SDO& channel) {
  Abort abort = Abort::none;
  uint32_t position = channel.Flow.Num + channel.Flow.Seq * wire::segment_bytes;
  CO_IF_FRM frame = wire::empty_frame(channel.TxId);
  while (channel.Flow.Seq != channel.Flow.BlkSize && provide_segment(channel, position, abort)) {
    const uint32_t left = channel.Read - position;
    fill_segment(frame, buffer_of(channel) + channel.Flow.Fill - left, left);
    position += smaller(wire::segment_bytes, left);
    const bool last = position == channel.Flow.Size;
    frame.Data[0] = wire::block_segment(static_cast<uint8_t>(channel.Flow.Seq + 1), last);
    if (!transmit::offer(*channel.Node, frame)) {
      break;
    }
    ++channel.Flow.Seq;
    if (last) {
      channel.Flow.BlkSize = channel.Flow.Seq;
      set(channel.Flow, last_sent);
    }
  }
  return abort;
}

Abort check_block_upload(const CO_SDO& channel, const CO_OBJ& obj, const CO_IF_FRM& request) {
  if (!wire::is_blksize(request.Data[4])) {
    return Abort::block_size;
  }
  // Data that cannot be read again have to fit into the buffer.
  const bool can_go_back =
      obj::can_seek(obj) || channel.Flow.Size <= sizeof channel.Value || channel.Flow.Size <= CO_SDO_BUF_BYTE;
  return can_go_back || !is_worth_block(channel.Flow.Size, request) ? Abort::none : Abort::command;
}

Abort start_block_upload(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  silence(answer);
  set_state(channel, State::block_upload);
  return send_segments(channel);
}

Abort acknowledge_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  const Abort abort = acknowledge_sent(channel.Flow, request);
  if (abort != Abort::none) {
    return abort;
  }
  if (has(channel.Flow, last_sent)) {
    put_end(channel.Flow, answer);
    set_state(channel, State::block_upload_end);
    return Abort::none;
  }
  silence(answer);
  return send_segments(channel);
}

Abort end_block_upload(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  silence(answer);
  return close(channel, Abort::none);
}

}  // namespace co::sdo::server

#endif
