// SPDX-License-Identifier: Apache-2.0
// Segments in sequence that are not the last one of their transfer or block: of a domain, or of a block download. They
// call no type function and do not change the state of the transfer, so the server processes them at once.
#pragma once

#include "base/events.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "co_domain.h"
#include "dictionary/obj.hpp"
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {

// Segmented transfer. Returns whether the request contains or asks for 7 bytes in sequence, and more are left.
[[gnu::always_inline]] inline bool is_next_segment(const CO_SDO& channel, const CO_IF_FRM& request, bool is_upload) {
  const uint8_t command = is_upload ? wire::upload_segment_request(0) : wire::segment(0, wire::segment_bytes, false);
  return request.Data[0] - command == (channel.Flags & toggled) && channel.Size - channel.Num > wire::segment_bytes;
}

// Returns the next segment of a domain in its memory, and sets its position behind it, as its Read and Write functions
// do. Returns null, and changes nothing, if the entry was moved, is no domain of this library, or ends before. More
// than a segment of the transfer is left.
[[gnu::always_inline]] inline uint8_t* next_of_domain(const CO_SDO& channel) {
  const CO_OBJ* const obj = channel.Obj;
  if (obj == nullptr || obj->Type != CO_TDOMAIN) {
    return nullptr;
  }
  auto* const domain = data_of<CO_OBJ_DOM>(*obj);
  const uint32_t end = channel.Num + wire::segment_bytes;
  if (domain == nullptr || domain->Start == nullptr || domain->Size < end) {
    return nullptr;
  }
  domain->Offset = end;
  return domain->Start + channel.Num;
}

// Segmented transfer of a domain.
[[gnu::always_inline]] inline bool pass_segment(CO_SDO& channel, const CO_IF_FRM& request, bool is_upload) {
  CO_NODE& node = *channel.Node;
  if (!is_next_segment(channel, request, is_upload) || (!is_upload && node.Ext->Writable != nullptr)) {
    return false;
  }
  const CO_OBJ* const obj = channel.Obj;
  uint8_t* const bytes = next_of_domain(channel);
  if (bytes == nullptr) {
    return false;
  }
  CO_IF_FRM answer = wire::empty_frame(channel.TxId);
  const auto toggle = static_cast<uint8_t>(channel.Flags & toggled);
  answer.Data[0] =
      is_upload ? wire::segment(toggle, wire::segment_bytes, false) : wire::download_segment_response(toggle);
  wire::copy_segment(is_upload ? answer.Data + 1 : bytes, is_upload ? bytes : request.Data + 1);
  channel.Num += wire::segment_bytes;
  channel.Flags ^= toggled;
  channel.Idle = 0;
  if (!is_upload) {
    event::write_object(node, *obj);
  }
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {  // otherwise a type of the application has changed the NMT state
    transmit::send(node, answer);
  }
  return true;
}

#if USE_SDO_BLOCK
// Block download: the segment after the previous one, in a block of which no segment is missing.
[[gnu::always_inline]] inline bool store_straight(CO_SDO& channel, const CO_IF_FRM& segment) {
  const uint8_t number = segment.Data[0];
  const uint32_t end = channel.Fill + wire::segment_bytes;
  const bool is_next = number == channel.Seq + 1 && channel.Heard == channel.Seq;
  if (!is_next || number >= channel.BlkSize || end > channel.Size - channel.Num) {
    return false;
  }
  CO_ASSERT(end <= CO_SDO_BUF_BYTE);
  wire::copy_segment(buffer_of(channel) + channel.Fill, segment.Data + 1);
  channel.Fill = static_cast<uint16_t>(end);
  channel.Seq = number;
  channel.Heard = number;
  channel.Idle = 0;
  return true;
}
#else
inline bool store_straight(const CO_SDO&, const CO_IF_FRM&) { return false; }
#endif

// Processes a segment of an open transfer. Returns false, and changes nothing, if the state machine of the server
// has to process the frame.
[[gnu::always_inline]] inline bool answer_segment(CO_SDO& channel, const CO_IF_FRM& frame) {
  const State state = state_of(channel);
  if (state == State::block_download) {
    return store_straight(channel, frame);
  }
  const bool is_upload = state == State::upload;
  return (is_upload || state == State::download) && pass_segment(channel, frame, is_upload);
}

}  // namespace co::sdo_server
