// SPDX-License-Identifier: Apache-2.0
// Block upload. The segments come out of the buffer, a window of the object that goes back when the client has lost
// some. They are sent as the controller takes them. [301:7.2.4.3.13-15]
#include "core/events.hpp"
#include "core/transmit.hpp"
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

constexpr uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

uint32_t segment_position(const CO_SDO& channel) { return channel.Num + channel.Seq * wire::segment_bytes; }

bool is_in_buffer(const CO_SDO& channel, uint32_t position) {
  return position < channel.Read && channel.Read - position <= channel.Fill;
}

// What cannot be read again has to fit into the buffer.
bool can_go_back(const CO_SDO& channel) {
  return obj::can_seek(*channel.Obj) || channel.Size <= sizeof channel.Value || channel.Size <= CO_SDO_BUF_BYTE;
}

// The CRC covers each byte once, also if the client has lost it.
void sum(CO_SDO& channel, uint32_t position) {
  if (channel.Read <= channel.Summed) {
    return;
  }
  const uint32_t from = channel.Summed - position;
  if (has(channel, crc)) {
    channel.Crc = wire::crc16(channel.Crc, buffer_of(channel) + from, channel.Fill - from);
  }
  channel.Summed = channel.Read;
}

uint32_t load(CO_SDO& channel, uint32_t position) {
  if (is_gone(channel)) {
    return CO_SDO_ERR_TOS_STATE;
  }
  uint32_t n = smaller(CO_SDO_BUF_BYTE, channel.Size - position);
  __builtin_memset(buffer_of(channel), 0, n);  // what a type does not fill is not old data
  const uint32_t abort = get(channel, position, buffer_of(channel), n);
  channel.Read = position + n;
  channel.Fill = static_cast<uint16_t>(n);
  if (abort == no_abort) {
    sum(channel, position);
  }
  return abort;
}

bool has_more(const CO_SDO& channel) {
  return state_of(channel) == State::block_upload && channel.Seq < channel.BlkSize && !has(channel, last_sent);
}

}  // namespace

bool send_segment(CO_SDO& channel, uint32_t& abort) {
  CO_NODE& node = *channel.Node;
  if (!has_more(channel)) {
    return false;
  }
  const uint32_t position = segment_position(channel);
  if (position < channel.Size && !is_in_buffer(channel, position)) {
    abort = load(channel, position);
    if (abort != no_abort || !event::is_allowed(node, CO_SDO_ALLOWED)) {
      return false;
    }
  }
  const uint32_t n = smaller(wire::segment_bytes, position < channel.Read ? channel.Read - position : 0);
  const bool last = position + n == channel.Size;
  CO_IF_FRM frame = wire::empty_frame(channel.TxId);
  frame.Data[0] = wire::block_segment(static_cast<uint8_t>(channel.Seq + 1), last);
  __builtin_memcpy(frame.Data + 1, buffer_of(channel) + channel.Fill - (channel.Read - position), n);
  if (!transmit::offer(node, frame)) {
    return false;
  }
  ++channel.Seq;
  channel.Idle = 0;
  if (last) {
    set(channel, last_sent);
  }
  return true;
}

namespace {

uint32_t send_segments(CO_SDO& channel) {
  uint32_t abort = no_abort;
  while (send_segment(channel, abort)) {
  }
  return abort;
}

}  // namespace

uint32_t initiate_block_upload(Step& step) {
  CO_SDO& channel = step.channel;
  if (buffer_of(channel) == nullptr) {
    return CO_SDO_ERR_CMD;
  }
  uint32_t abort = open_upload(step);
  if (abort != no_abort) {
    return abort;
  }
  const uint8_t blksize = step.request.Data[4];
  const uint8_t switch_threshold = step.request.Data[5];
  if (!wire::is_blksize(blksize)) {
    return CO_SDO_ERR_BLK_SIZE;
  }
  if (switch_threshold != 0 && channel.Size <= switch_threshold) {
    return ordinary_upload(step);
  }
  if (!can_go_back(channel)) {
    return CO_SDO_ERR_CMD;
  }
  abort = begin_upload(step, false);
  if (abort != no_abort) {
    return abort;
  }
  if (wire::has_crc(step.request.Data[0])) {
    set(channel, crc);
  }
  channel.Crc = 0;
  channel.Summed = 0;
  channel.Fill = 0;
  channel.Seq = 0;
  channel.BlkSize = blksize;
  answer_size(channel, wire::initiate_block(channel.Size != CO_OBJ_SIZE_UNKNOWN), step.answer);
  set_state(channel, State::block_upload_ready);
  return no_abort;
}

uint32_t start_block_upload(Step& step) {
  step.silent = true;
  set_state(step.channel, State::block_upload);
  return send_segments(step.channel);
}

uint32_t acknowledge_block(Step& step) {
  CO_SDO& channel = step.channel;
  const uint8_t ackseq = step.request.Data[1];
  const uint8_t blksize = step.request.Data[2];
  if (ackseq > channel.Seq) {
    return CO_SDO_ERR_SEQ_NUM;
  }
  if (!wire::is_blksize(blksize)) {
    return CO_SDO_ERR_BLK_SIZE;
  }
  const uint32_t acknowledged = ackseq * wire::segment_bytes;
  if (ackseq == channel.Seq && has(channel, last_sent)) {
    step.answer.Data[0] = wire::end_block(channel.Num + acknowledged - channel.Size);
    wire::put_u16(step.answer.Data + 1, channel.Crc);
    set_state(channel, State::block_upload_end);
    return no_abort;
  }
  channel.Num += acknowledged;
  channel.BlkSize = blksize;
  channel.Seq = 0;
  clear(channel, last_sent);
  step.silent = true;
  return send_segments(channel);
}

uint32_t end_block_upload(Step& step) {
  step.silent = true;
  close(step.channel, no_abort);
  return no_abort;
}

}  // namespace co::sdo_server
