// SPDX-License-Identifier: Apache-2.0
// Downloads by a client: expedited, segments and blocks. [301:7.2.4.3.3-4, 7.2.4.3.9]
#include "base/transmit.hpp"
#include "service/sdo/client.hpp"

namespace co::sdo_client {

namespace {

uint32_t next_length(const CO_CSDO& client) {
  const uint32_t left = client.Size - client.Num;
  return left < wire::segment_bytes ? left : wire::segment_bytes;
}

void put_segment(const CO_CSDO& client, CO_IF_FRM& request) {
  const uint32_t n = next_length(client);
  request.Data[0] = wire::segment(client.Toggle, n, client.Num + n == client.Size);
  __builtin_memcpy(request.Data + 1, client.Buf + client.Num, n);
}

}  // namespace

Abort download_accepted(Step& step) {
  CO_CSDO& client = step.client;
  if (is_expedited(client)) {
    client.Num = client.Size;
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  set_state(client, State::download);
  return Abort::none;
}

Abort segment_downloaded(Step& step) {
  CO_CSDO& client = step.client;
  if (wire::toggle(step.response) != client.Toggle) {
    return Abort::toggle_bit;
  }
  client.Num += next_length(client);
  client.Toggle ^= wire::toggle_bit;
  if (client.Num == client.Size) {
    step.silent = true;
    step.done = true;
    return Abort::none;
  }
  put_segment(client, step.request);
  return Abort::none;
}

}  // namespace co::sdo_client

// Block download: segments are read from the caller's buffer. [301:7.2.4.3.9-11]

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace co::sdo_client {
namespace {

void begin_block(CO_CSDO& client, uint8_t blksize) {
  client.BlkSize = blksize;
  client.Seq = 0;
  clear(client, last_sent);
}

// Counts acknowledged segments; Num never exceeds Size.
void count_acknowledged(CO_CSDO& client, uint32_t segments) {
  const uint32_t left = client.Size - client.Num;
  const uint32_t n = segments * wire::segment_bytes < left ? segments * wire::segment_bytes : left;
  if (has(client, crc)) {
    client.Crc = wire::crc16(client.Crc, client.Buf + client.Num, n);
  }
  client.Num += n;
}

// Returns whether an acknowledge that arrives before all segments of the block were sent may repeat that of the
// previous block: the server has waited too long for segments of this one.
bool is_of_block_before(const CO_CSDO& client) {
  const bool is_whole = client.Seq == client.BlkSize || has(client, last_sent);
  return client.Num != 0 && !is_whole;
}

uint32_t unused_in_last(uint32_t size) {
  return (wire::segment_bytes - size % wire::segment_bytes) % wire::segment_bytes;
}

// Sends the next segment. Returns false if there is none, or the controller does not accept it.
bool send_segment(CO_CSDO& client) {
  if (state_of(client) != State::block_download || client.Seq == client.BlkSize || has(client, last_sent)) {
    return false;
  }
  const uint32_t position = client.Num + client.Seq * wire::segment_bytes;
  const uint32_t left = client.Size - position;
  const bool last = left <= wire::segment_bytes;
  CO_IF_FRM frame = wire::empty_frame(client.TxId);
  frame.Data[0] = wire::block_segment(static_cast<uint8_t>(client.Seq + 1), last);
  __builtin_memcpy(frame.Data + 1, client.Buf + position, last ? left : wire::segment_bytes);
  if (!transmit::offer(*client.Node, frame)) {
    return false;
  }
  ++client.Seq;
  if (last) {
    set(client, last_sent);
  }
  return true;
}

}  // namespace

bool send_segments(CO_CSDO& client) {
  bool sent = false;
  while (send_segment(client)) {
    sent = true;
  }
  return sent;
}

Abort block_download_accepted(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t blksize = step.response.Data[4];
  step.silent = true;
  if (state_of(client) == State::block_download) {  // repeated by a server that has waited too long for segments
    return Abort::none;
  }
  if (!wire::is_blksize(blksize)) {
    return Abort::block_size;
  }
  if (wire::has_crc(step.response.Data[0])) {
    set(client, crc);
  }
  begin_block(client, blksize);
  set_state(client, State::block_download);
  return Abort::none;
}

Abort block_acknowledged(Step& step) {
  CO_CSDO& client = step.client;
  const uint8_t ackseq = step.response.Data[1];
  const uint8_t blksize = step.response.Data[2];
  if (ackseq > client.Seq) {
    step.silent = is_of_block_before(client);
    return step.silent ? Abort::none : Abort::sequence_number;
  }
  if (!wire::is_blksize(blksize)) {
    return Abort::block_size;
  }
  const bool all = ackseq == client.Seq && has(client, last_sent);
  count_acknowledged(client, ackseq);
  if (all) {
    step.request.Data[0] = wire::end_block(unused_in_last(client.Size));
    wire::put_u16(step.request.Data + 1, client.Crc);
    set_state(client, State::block_download_end);
    return Abort::none;
  }
  begin_block(client, blksize);
  step.silent = true;
  return Abort::none;
}

Abort block_download_confirmed(Step& step) {
  step.silent = true;
  step.done = true;
  return Abort::none;
}

}  // namespace co::sdo_client

#endif
