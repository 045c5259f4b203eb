// SPDX-License-Identifier: Apache-2.0
// Downloads by a client: expedited, segments and blocks. [301:7.2.4.3.3-4, 7.2.4.3.9]
#include "base/transmit.hpp"
#include "service/sdo/client.hpp"

namespace co::sdo::client {
namespace {

uint32_t next_length(const CO_SDO_FLOW& flow) {
  const uint32_t left = flow.Size - flow.Num;
  return left < wire::segment_bytes ? left : wire::segment_bytes;
}

void put_segment(const CO_CSDO& client, CO_IF_FRM& request) {
  const CO_SDO_FLOW& flow = client.Flow;
  const uint32_t n = next_length(flow);
  request.Data[0] = wire::segment(flow.Flags & toggled, n, flow.Num + n == flow.Size);
  __builtin_memcpy(request.Data + 1, client.Buf + flow.Num, n);
}

}  // namespace

Abort download_accepted(Step& step) {
  CO_CSDO& client = step.client;
  if (is_expedited(client)) {
    client.Flow.Num = client.Flow.Size;
    return complete(step);
  }
  put_segment(client, step.request);
  set_state(client, State::download);
  return Abort::none;
}

Abort segment_downloaded(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  if (wire::toggle(step.response) != (flow.Flags & toggled)) {
    return Abort::toggle_bit;
  }
  flow.Num += next_length(flow);
  flow.Flags ^= toggled;
  if (flow.Num == flow.Size) {
    return complete(step);
  }
  put_segment(step.client, step.request);
  return Abort::none;
}

Abort complete(Step& step) {
  silence(step.request);
  step.done = true;
  return Abort::none;
}

}  // namespace co::sdo::client

// Block download: segments are read from the caller's buffer. [301:7.2.4.3.9-11]

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace co::sdo::client {
namespace {

// Sends the next segment. Returns false if there is none, or the controller does not accept it.
bool send_segment(CO_CSDO& client) {
  CO_SDO_FLOW& flow = client.Flow;
  if (state_of(client) != State::block_download || flow.Seq == flow.BlkSize) {
    return false;
  }
  const uint32_t position = flow.Num + flow.Seq * wire::segment_bytes;
  const uint32_t left = flow.Size - position;
  const bool last = left <= wire::segment_bytes;
  CO_IF_FRM frame = wire::empty_frame(client.TxId);
  frame.Data[0] = wire::block_segment(static_cast<uint8_t>(flow.Seq + 1), last);
  __builtin_memcpy(frame.Data + 1, client.Buf + position, last ? left : wire::segment_bytes);
  if (!transmit::offer(*client.Node, frame)) {
    return false;
  }
  ++flow.Seq;
  if (last) {
    flow.BlkSize = flow.Seq;
    set(flow, last_sent);
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
  silence(step.request);
  if (state_of(client) == State::block_download) {  // repeated by a server that has waited too long for segments
    return Abort::none;
  }
  if (!wire::is_blksize(blksize)) {
    return Abort::block_size;
  }
  begin_blocks(client.Flow, step.response, blksize);
  set_state(client, State::block_download);
  return Abort::none;
}

Abort block_acknowledged(Step& step) {
  CO_SDO_FLOW& flow = step.client.Flow;
  const uint32_t from = flow.Num;
  const Abort abort = acknowledge_sent(flow, step.response);
  const uint32_t to = flow.Num < flow.Size ? flow.Num : flow.Size;
  if (has(flow, crc)) {
    flow.Crc = wire::crc16(flow.Crc, step.client.Buf + from, to - from);
  }
  if (has(flow, last_sent)) {
    put_end(flow, step.request);
    set_state(step.client, State::block_download_end);
  } else {
    silence(step.request);
  }
  return abort;
}

}  // namespace co::sdo::client

#endif
