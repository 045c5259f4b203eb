// SPDX-License-Identifier: Apache-2.0
// Blocks that a server or a client sends or receives, and their repair after lost frames. [301:7.2.4.3.9-15]
#include "service/sdo/flow.hpp"

#if USE_SDO_BLOCK

namespace co::sdo {
namespace {

// Starts a block to be sent or received.
void begin_block(CO_SDO_FLOW& flow, uint8_t blksize) {
  flow.BlkSize = blksize;
  flow.Seq = 0;
  flow.Heard = 0;
  clear(flow, last_sent);
}

}  // namespace

void begin_blocks(CO_SDO_FLOW& flow, const CO_IF_FRM& initiate, uint8_t blksize) {
  if (wire::has_crc(initiate.Data[0])) {
    set(flow, crc);
  }
  flow.Crc = 0;
  flow.Fill = 0;
  flow.AckSize = 0;
  begin_block(flow, blksize);
}

// Blocks sent

namespace {

// Returns whether an acknowledge that arrives before all segments of the block were sent may repeat that of the
// previous block: the receiver has waited too long for segments of this one.
bool is_of_block_before(const CO_SDO_FLOW& flow) { return flow.Num != 0 && flow.Seq != flow.BlkSize; }

}  // namespace

Abort acknowledge_sent(CO_SDO_FLOW& flow, const CO_IF_FRM& frame) {
  const uint8_t ackseq = frame.Data[1];
  const uint8_t blksize = frame.Data[2];
  if (ackseq > flow.Seq) {
    return is_of_block_before(flow) ? Abort::none : Abort::sequence_number;
  }
  if (!wire::is_blksize(blksize)) {
    return Abort::block_size;
  }
  flow.Num += ackseq * wire::segment_bytes;
  if (ackseq != flow.Seq || !has(flow, last_sent)) {
    begin_block(flow, blksize);
  }
  return Abort::none;
}

void put_end(CO_SDO_FLOW& flow, CO_IF_FRM& frame) {
  frame.Data[0] = wire::end_block(flow.Num - flow.Size);
  wire::put_u16(frame.Data + 1, flow.Crc);
  flow.Num = flow.Size;
}

// Blocks received

namespace {

// Stores a segment. The number of data bytes in the last segment is known only from the end message.
void store_segment(CO_SDO_FLOW& flow, uint8_t* buffer, const CO_IF_FRM& segment) {
  const uint32_t room = flow.Size - flow.Num - flow.Fill;
  const uint32_t n = room < wire::segment_bytes ? room : wire::segment_bytes;
  if (n < wire::segment_bytes && !wire::is_last_in_block(segment.Data[0])) {
    set(flow, too_long);
    return;
  }
  wire::copy(buffer + flow.Fill, segment.Data + 1, n);
  flow.Fill = static_cast<uint16_t>(flow.Fill + wire::segment_bytes);
  ++flow.Seq;
  flow.Idle = 0;
}

void put_acknowledge(const CO_SDO_FLOW& flow, CO_IF_FRM& frame) {
  frame.Data[0] = wire::acknowledge_block;
  frame.Data[1] = flow.AckSeq;
  frame.Data[2] = flow.AckSize;
}

// Returns whether a frame is a valid end message. The last segment of some objects has the same form.
bool is_right_end(const CO_SDO_FLOW& flow, const uint8_t* buffer, const CO_IF_FRM& frame) {
  const uint32_t total = flow.Num + last_bytes(flow, frame);
  return wire::is_end_of_blocks(frame.Data[0]) && (has(flow, sized) ? total == flow.Size : total <= flow.Size) &&
         is_crc_right(flow, buffer, frame);
}

}  // namespace

// If the first segment of a block to arrive is its end, it is either the repeated end of the previous block, or all
// other segments were lost. The receiver does not respond; it sends the acknowledge again after a part of the time-out.
//
// The time-out is restarted by a segment in sequence, and by one behind a gap whose number is higher than all before,
// because the sender is sending the rest of its block. A block without any segment in sequence permits that only once.
// Therefore neither repeated requests of a polling client, which look like segments, nor data beyond the size keep the
// transfer open.
Arrival receive_segment(CO_SDO_FLOW& flow, uint8_t* buffer, const CO_IF_FRM& segment) {
  const uint8_t number = wire::seqno(segment.Data[0]);
  if (number == 0 || number > flow.BlkSize) {
    return Arrival::within;
  }
  const bool in_order = number == flow.Seq + 1;
  const bool may_repeat = flow.Heard == 0 && number != 1 && flow.AckSize != 0;
  if (number > flow.Heard) {
    flow.Heard = number;
    if (flow.AckSize == 0 || flow.AckSeq != 0) {
      flow.Idle = 0;
    }
  }
  if (in_order) {
    store_segment(flow, buffer, segment);
  }
  const bool is_last = wire::is_last_in_block(segment.Data[0]);
  if (may_repeat || (!is_last && number != flow.BlkSize)) {
    return Arrival::within;
  }
  return in_order && is_last ? Arrival::last : Arrival::end;
}

void acknowledge(CO_SDO_FLOW& flow, uint8_t blksize, CO_IF_FRM& frame) {
  flow.AckSeq = flow.Seq;
  flow.AckSize = blksize;
  begin_block(flow, blksize);
  put_acknowledge(flow, frame);
}

bool repeat_acknowledge(CO_SDO_FLOW& flow, uint8_t blksize, CO_IF_FRM& frame) {
  if (flow.Heard != 0) {
    acknowledge(flow, blksize, frame);
  } else {
    put_acknowledge(flow, frame);
  }
  return flow.AckSize != 0;
}

void add_to_crc(CO_SDO_FLOW& flow, const uint8_t* buffer) {
  if (has(flow, crc)) {
    flow.Crc = wire::crc16(flow.Crc, buffer, flow.Fill);
  }
}

bool is_last_segment_again(const CO_SDO_FLOW& flow, const uint8_t* buffer, const CO_IF_FRM& frame) {
  const uint32_t at = flow.Fill - wire::segment_bytes;
  const uint32_t room = flow.Size - flow.Num - at;
  return frame.Data[0] == wire::block_segment(flow.AckSeq, true) &&
         wire::is_equal(frame.Data + 1, buffer + at, room < wire::segment_bytes ? room : wire::segment_bytes) &&
         !is_right_end(flow, buffer, frame);
}

bool is_crc_right(const CO_SDO_FLOW& flow, const uint8_t* buffer, const CO_IF_FRM& end) {
  return !has(flow, crc) || wire::crc16(flow.Crc, buffer, last_bytes(flow, end)) == wire::get_u16(end.Data + 1);
}

}  // namespace co::sdo

#endif
