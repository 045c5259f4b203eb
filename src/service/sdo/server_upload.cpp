// SPDX-License-Identifier: Apache-2.0
// Uploads from a server: segments and blocks. [301:7.2.4.3.7, 7.2.4.3.13]
#include "base/events.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/sdo/server.hpp"

namespace co::sdo_server {

Abort upload_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  Abort abort = check_segment(channel, request);
  if (abort != Abort::none) {
    return abort;
  }
  const uint32_t position = channel.Num;
  const uint32_t left = channel.Size - position;
  abort = transfer_piece(channel, position, answer.Data + 1, left < wire::segment_bytes ? left : wire::segment_bytes);
  if (abort != Abort::none) {
    return abort;
  }
  channel.Num = channel.Read;
  const bool last = channel.Num == channel.Size;
  answer.Data[0] = wire::segment(channel.Flags & toggled, channel.Num - position, last);
  channel.Flags ^= toggled;
  return last ? close(channel, Abort::none) : Abort::none;
}

}  // namespace co::sdo_server

// Block upload. The buffer holds a window of the object, which goes back when the client has lost segments. Segments
// are sent as the controller accepts them. [301:7.2.4.3.13-15]

#if USE_SDO_BLOCK

namespace co::sdo_server {
namespace {

constexpr uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

// Updates the CRC, which covers each byte once, even if it is sent again.
void add_to_crc(CO_SDO& channel, uint32_t position) {
  if (channel.Read <= channel.Summed) {
    return;
  }
  const uint32_t from = channel.Summed - position;
  if (has(channel, crc)) {
    channel.Crc = wire::crc16(channel.Crc, buffer_of(channel) + from, channel.Fill - from);
  }
  channel.Summed = channel.Read;
}

// Pauses the transfer until the next call of CONodeProcess() or COTmrProcess().
void pause(CO_NODE& node) {
  node.Transmit.Paused = 1;
  node.Transmit.Burst = CO_SDO_BLOCK_PACE;
}

Abort load(CO_SDO& channel, uint32_t position) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  CO_ASSERT(position < channel.Size);
  const uint32_t n = smaller(CO_SDO_BUF_BYTE, channel.Size - position);
  __builtin_memset(buffer_of(channel), 0, n);  // clears bytes that the type may not fill
  const Abort abort = transfer_piece(channel, position, buffer_of(channel), n);
  if (has(channel, behind)) {
    channel.Fill = 0;
    pause(*channel.Node);
    return Abort::none;
  }
  channel.Fill = static_cast<uint16_t>(channel.Read - position);
  if (abort == Abort::none) {
    add_to_crc(channel, position);
  }
  return abort;
}

// Returns whether the segment at the position is in the buffer, after reading it if necessary. Otherwise abort is the
// reason, if SDO is still allowed.
bool provide(CO_SDO& channel, uint32_t position, Abort& abort) {
  if (channel.Read - position - 1 < channel.Fill || position >= channel.Size) {
    return true;
  }
  abort = load(channel, position);
  const bool is_there = abort == Abort::none && !has(channel, behind);
  clear(channel, behind);
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
  uint32_t position = channel.Num + channel.Seq * wire::segment_bytes;
  CO_IF_FRM frame = wire::empty_frame(channel.TxId);
  while (channel.Seq != channel.BlkSize && provide(channel, position, abort)) {
    const uint32_t left = channel.Read - position;
    fill_segment(frame, buffer_of(channel) + channel.Fill - left, left);
    position += smaller(wire::segment_bytes, left);
    const bool last = position == channel.Size;
    frame.Data[0] = wire::block_segment(static_cast<uint8_t>(channel.Seq + 1), last);
    if (!transmit::offer(*channel.Node, frame)) {
      break;
    }
    ++channel.Seq;
    if (last) {
      channel.BlkSize = channel.Seq;
      set(channel, last_sent);
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
      obj::can_seek(obj) || channel.Size <= sizeof channel.Value || channel.Size <= CO_SDO_BUF_BYTE;
  return can_go_back || !is_worth_block(channel.Size, request) ? Abort::none : Abort::command;
}

void begin_block_upload(CO_SDO& channel, const CO_IF_FRM& request) {
  if (wire::has_crc(request.Data[0])) {
    set(channel, crc);
  }
  channel.Crc = 0;
  channel.Summed = 0;
  channel.Fill = 0;
  channel.Seq = 0;
  channel.BlkSize = request.Data[4];
}

Abort start_block_upload(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  silence(answer);
  set_state(channel, State::block_upload);
  return send_segments(channel);
}

Abort acknowledge_block(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  const uint8_t ackseq = request.Data[1];
  const uint8_t blksize = request.Data[2];
  if (ackseq > channel.Seq) {
    return Abort::sequence_number;
  }
  if (!wire::is_blksize(blksize)) {
    return Abort::block_size;
  }
  const uint32_t acknowledged = ackseq * wire::segment_bytes;
  if (ackseq == channel.Seq && has(channel, last_sent)) {
    answer.Data[0] = wire::end_block(channel.Num + acknowledged - channel.Size);
    wire::put_u16(answer.Data + 1, channel.Crc);
    set_state(channel, State::block_upload_end);
    return Abort::none;
  }
  channel.Num += acknowledged;
  channel.BlkSize = blksize;
  channel.Seq = 0;
  clear(channel, last_sent);
  silence(answer);
  return send_segments(channel);
}

Abort end_block_upload(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  silence(answer);
  return close(channel, Abort::none);
}

}  // namespace co::sdo_server

#endif
