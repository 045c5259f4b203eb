// SPDX-License-Identifier: Apache-2.0
// Downloads to a server: segments, the end of every download, and blocks. [301:7.2.4.3.4, 7.2.4.3.9]
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/sdo/server.hpp"

namespace co::sdo_server {

Abort check_total(CO_SDO& channel, uint32_t total) {
  if (total > channel.Size) {
    return Abort::too_long;
  }
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  return has(channel, sized) ? access::compare_length(total, channel.Size)
                             : access::check_length(*channel.Node, *channel.Obj, total);
}

Abort finish_download(CO_SDO& channel) {
  CO_ASSERT(!has(channel, whole) || channel.Obj != nullptr);
  const Abort abort = has(channel, whole) ? begin_data(channel, *channel.Obj, channel.Value, channel.Num) : Abort::none;
  return abort == Abort::none ? close(channel, Abort::none) : abort;
}

Abort download_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  const uint8_t command = request.Data[0];
  Abort abort = check_segment(channel, request);
  if (abort != Abort::none) {
    return abort;
  }
  const uint32_t left = channel.Size - channel.Num;
  const uint32_t n = has(channel, sized) ? wire::segment_length(command, left) : wire::segment_length(command);
  if (n > left) {
    return Abort::too_long;
  }
  if (wire::is_last_segment(command)) {
    set_total(channel, n);
  }
  CO_IF_FRM segment = request;  // a copy, because a type function may change its buffer
  abort = transfer_piece(channel, channel.Num, segment.Data + 1, n);
  channel.Num = channel.Read;
  answer.Data[0] = wire::download_segment_response(channel.Flags & toggled);
  channel.Flags ^= toggled;
  if (abort != Abort::none || !wire::is_last_segment(command)) {
    return abort;
  }
  abort = check_total(channel, channel.Num);
  return abort == Abort::none ? finish_download(channel) : abort;
}

}  // namespace co::sdo_server

// Block download. Segments are collected in the buffer, which is written to the object when it is full, and at the end
// of the transfer after the checks of length and CRC. [301:7.2.4.3.9-11]

#if USE_SDO_BLOCK

namespace co::sdo_server {
namespace {

// Starts a block of as many segments as fit into the buffer.
void begin_block(CO_SDO& channel) {
  const auto room = static_cast<uint8_t>((CO_SDO_BUF_BYTE - channel.Fill) / wire::segment_bytes);
  channel.BlkSize = room != 0 ? room : CO_SDO_BUF_SEG;
  channel.Seq = 0;
  channel.Heard = 0;
}

void add_to_crc(CO_SDO& channel, uint32_t n) {
  if (has(channel, crc)) {
    channel.Crc = wire::crc16(channel.Crc, buffer_of(channel), n);
  }
}

// Stores a segment. Errors are reported at the end of the block, because the client's further segments could otherwise
// be taken for commands.
void store_segment(CO_SDO& channel, const CO_IF_FRM& segment) {
  const uint32_t least = wire::is_last_in_block(segment.Data[0]) ? 0 : wire::segment_bytes;
  if (channel.Fill + least > channel.Size - channel.Num) {
    set(channel, too_long);
    return;
  }
  CO_ASSERT(channel.Fill + wire::segment_bytes <= CO_SDO_BUF_BYTE);
  wire::copy_segment(buffer_of(channel) + channel.Fill, segment.Data + 1);
  channel.Fill = static_cast<uint16_t>(channel.Fill + wire::segment_bytes);
  ++channel.Seq;
}

Abort write_buffer(CO_SDO& channel, uint32_t n) {
  const bool opens = channel.Num == 0 && !has(channel, whole);
  Abort abort = opens ? begin_data(channel, *channel.Obj, channel.Value, 0) : Abort::none;
  channel.Fill = 0;
  if (abort == Abort::none) {
    abort = transfer_piece(channel, channel.Num, buffer_of(channel), n);
    channel.Num = channel.Read;
  }
  return abort;
}

// Writes the full buffer to the object.
Abort empty_buffer(CO_SDO& channel) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  add_to_crc(channel, channel.Fill);
  return write_buffer(channel, channel.Fill);
}

void put_acknowledge(const CO_SDO& channel, CO_IF_FRM& answer) {
  answer.Data[0] = wire::acknowledge_block;
  answer.Data[1] = channel.AckSeq;
  answer.Data[2] = channel.AckSize;
}

// Acknowledges the segments in sequence: the client continues behind the last of them.
void acknowledge(CO_SDO& channel, CO_IF_FRM& answer) {
  channel.AckSeq = channel.Seq;
  begin_block(channel);
  channel.AckSize = channel.BlkSize;
  put_acknowledge(channel, answer);
}

// Returns whether a frame is a valid end message. The last segment of some objects has the same form.
bool is_right_end(const CO_SDO& channel, const CO_IF_FRM& frame) {
  const uint32_t n = channel.Fill - wire::unused_in_block(frame.Data[0]);
  return wire::request_of(frame.Data[0]) == wire::Request::end_block_download &&
         (!has(channel, sized) || channel.Num + n == channel.Size) &&
         (!has(channel, crc) || wire::crc16(channel.Crc, buffer_of(channel), n) == wire::get_u16(frame.Data + 1));
}

}  // namespace

void begin_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  if (wire::has_crc(request.Data[0])) {
    set(channel, crc);
  }
  channel.Crc = 0;
  channel.Fill = 0;
  channel.AckSize = 0;
  begin_block(channel);
  answer.Data[4] = channel.BlkSize;
}

// Restarts the time-out for a segment in sequence, and for one behind a gap whose number is higher than all before,
// because the client is sending the rest of its block. A block without any segment in sequence permits that only once.
// Therefore neither repeated requests of a polling client, which look like segments, nor data beyond the size keep the
// transfer open.
void restart_time_out(CO_SDO& channel, unsigned number) {
  const bool in_order = number == channel.Seq + 1U && !has(channel, too_long);
  const bool nothing_acknowledged = channel.AckSize != 0 && channel.AckSeq == 0;
  if (in_order || (number > channel.Heard && !nothing_acknowledged)) {
    channel.Idle = 0;
  }
}

// If the first segment of a block to arrive is its end, it is either the repeated end of the previous block, or all
// other segments were lost. The server does not respond; it sends the acknowledge again after a part of the time-out.
bool store_in_block(CO_SDO& channel, const CO_IF_FRM& segment) {
  const unsigned number = wire::seqno(segment.Data[0]);
  if (number - 1 >= channel.BlkSize || state_of(channel) != State::block_download) {
    return false;
  }
  const bool is_last = wire::is_last_in_block(segment.Data[0]);
  const bool in_order = number == channel.Seq + 1U;
  const bool begins = channel.Heard == 0;
  restart_time_out(channel, number);
  channel.Heard = static_cast<uint8_t>(number > channel.Heard ? number : channel.Heard);
  if (in_order) {
    store_segment(channel, segment);
  }
  if (!is_last && number != channel.BlkSize) {
    return false;
  }
  if (in_order && is_last) {
    set_state(channel, State::block_download_end);
  }
  const bool is_repeated = begins && number > 1 && channel.AckSize != 0;
  return !is_repeated;
}

Abort end_block(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  if (has(channel, too_long)) {
    return Abort::too_long;
  }
  const bool is_full = channel.Fill == CO_SDO_BUF_BYTE && state_of(channel) == State::block_download;
  const Abort abort = is_full ? empty_buffer(channel) : Abort::none;
  acknowledge(channel, answer);
  return abort;
}

bool is_last_segment_again(const CO_SDO& channel, const CO_IF_FRM& frame) {
  CO_ASSERT(channel.Fill >= wire::segment_bytes && channel.Fill <= CO_SDO_BUF_BYTE);
  const uint8_t* const stored = buffer_of(channel) + channel.Fill - wire::segment_bytes;
  return frame.Data[0] == wire::block_segment(channel.AckSeq, true) &&
         wire::is_equal(frame.Data + 1, stored, wire::segment_bytes) && !is_right_end(channel, frame);
}

Abort end_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  if (channel.Obj == nullptr) {
    return Abort::device_state;
  }
  const uint32_t n = channel.Fill - wire::unused_in_block(request.Data[0]);
  Abort abort = check_total(channel, channel.Num + n);
  if (abort != Abort::none) {
    return abort;
  }
  add_to_crc(channel, n);
  if (has(channel, crc) && channel.Crc != wire::get_u16(request.Data + 1)) {
    return Abort::crc;
  }
  set_total(channel, n);
  abort = write_buffer(channel, n);
  answer.Data[0] = wire::confirm_block;
  return abort == Abort::none ? finish_download(channel) : abort;
}

void repeat_acknowledge(CO_SDO& channel) {
  const State state = state_of(channel);
  if (state != State::block_download && state != State::block_download_end) {
    return;
  }
  if (has(channel, too_long)) {
    abort_transfer(channel, Abort::too_long);
    return;
  }
  CO_IF_FRM frame = wire::empty_frame(channel.TxId);
  if (channel.Heard != 0) {
    acknowledge(channel, frame);
  } else if (channel.AckSize != 0) {
    put_acknowledge(channel, frame);
  } else {
    wire::put_head(frame, wire::accept_block, channel.Key);
    frame.Data[4] = channel.BlkSize;
  }
  transmit::send(*channel.Node, frame);
}

}  // namespace co::sdo_server

#endif
