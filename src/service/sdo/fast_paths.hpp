// SPDX-License-Identifier: Apache-2.0
// Requests that a server answers at once, because they call no type function: expedited transfers of numbers that their
// variables hold as the bus transfers them, which leave no state, and segments in sequence. By the state machine alone
// an expedited upload or download takes 442 or 493 instructions (Cortex-M3), where the limit is 330.
#pragma once

#include "base/access_hook.hpp"
#include "base/events.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "co_domain.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/number.hpp"
#include "service/sdo/server.hpp"

namespace co::sdo::server {

// Returns whether a callback of the application takes part in transfers.
inline bool has_callbacks(const CO_NODE& node) {
#if USE_ACCESS_HOOK
  if (callback::find(node, &CO_CALLBACKS::AccessSdo) != nullptr) {
    return true;
  }
#endif
  return node.Ext->Writable != nullptr;
}

// Returns whether the request initiates an expedited transfer whose size is indicated, or any upload.
inline bool initiates_number(uint8_t command) {
  constexpr bool is_enabled = USE_FAST_PATHS != 0 && wire::host_is_little_endian;
  constexpr uint8_t length = 0x0C;
  return is_enabled &&
         (command == wire::initiate_upload_request || (command & ~length) == wire::expedited_download_request(4));
}

// Returns the object of a request that may initiate the transfer of a number; null if there is none: the request is
// aborted. No transfer is open.
inline CO_OBJ* find_number(CO_SDO& channel, const CO_IF_FRM& request) {
  const uint32_t key = wire::multiplexer(request);
  CO_OBJ* const obj = dict::find(*channel.Node, key);
  if (obj == nullptr) {
    channel.Key = key;
    abort_transfer(channel, access::check(*channel.Node, key, nullptr, CO_OBJ_UPLOAD));
  }
  return obj;
}

// Answers a request that find_number() has found an object for. Returns false if the state machine of the server
// has to process it: the object is no plain number, or the access is refused or left to callbacks.
[[gnu::always_inline]] inline bool answer_number(const CO_SDO& channel, const CO_IF_FRM& request, const CO_OBJ& obj) {
  CO_NODE& node = *channel.Node;
  const bool is_upload = request.Data[0] == wire::initiate_upload_request;
  const unsigned bytes = integer::plain_bytes(obj);
  const uint32_t right = is_upload ? CO_OBJ_____R_ : CO_OBJ______W;
  const uint32_t wrong = is_upload ? 0 : CO_OBJ___A___;
  if (bytes == 0 || (obj.Key & (right | wrong)) != right || has_callbacks(node)) {
    return false;
  }
  void* const address = data_of<void>(obj);
  CO_IF_FRM answer;
  answer.Identifier = channel.TxId;
  answer.DLC = wire::sdo_dlc;
  if (is_upload) {
    wire::put_reply(answer, wire::expedited_upload_response(bytes), request);
    wire::put_high(answer, integer::load_aligned(address, bytes));
  } else {
    if (wire::expedited_length(request.Data[0]) != bytes) {
      return false;
    }
    integer::store_aligned(address, wire::get_high(request), bytes);
    event::write_object(node, obj);
    if (!event::is_allowed(node, CO_SDO_ALLOWED)) {  // a type of the application has changed the NMT state
      return true;
    }
    wire::put_reply(answer, wire::initiate_download_response, request);
    wire::put_high(answer, 0);
  }
  transmit::send(node, answer);
  return true;
}

// Segments in sequence that are not the last one of their transfer or block: of a domain, or of a block download. They
// call no type function and do not change the state of the transfer, so the server processes them at once.

// Segmented transfer. Returns whether the request contains or asks for 7 bytes in sequence, and more are left.
[[gnu::always_inline]] inline bool is_next_segment(const CO_SDO& channel, const CO_IF_FRM& request, bool is_upload) {
  const uint8_t command = is_upload ? wire::upload_segment_request(0) : wire::segment(0, wire::segment_bytes, false);
  return request.Data[0] - command == (channel.Flow.Flags & toggled) &&
         channel.Flow.Size - channel.Flow.Num > wire::segment_bytes;
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
  const uint32_t end = channel.Flow.Num + wire::segment_bytes;
  if (domain == nullptr || domain->Start == nullptr || domain->Size < end) {
    return nullptr;
  }
  domain->Offset = end;
  return domain->Start + channel.Flow.Num;
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
  const auto toggle = static_cast<uint8_t>(channel.Flow.Flags & toggled);
  answer.Data[0] =
      is_upload ? wire::segment(toggle, wire::segment_bytes, false) : wire::download_segment_response(toggle);
  wire::copy_segment(is_upload ? answer.Data + 1 : bytes, is_upload ? bytes : request.Data + 1);
  channel.Flow.Num += wire::segment_bytes;
  channel.Flow.Flags ^= toggled;
  channel.Flow.Idle = 0;
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
  const uint32_t end = channel.Flow.Fill + wire::segment_bytes;
  const bool is_next = number == channel.Flow.Seq + 1 && channel.Flow.Heard == channel.Flow.Seq;
  if (!is_next || number >= channel.Flow.BlkSize || end > channel.Flow.Size - channel.Flow.Num) {
    return false;
  }
  CO_ASSERT(end <= CO_SDO_BUF_BYTE);
  wire::copy_segment(buffer_of(channel) + channel.Flow.Fill, segment.Data + 1);
  channel.Flow.Fill = static_cast<uint16_t>(end);
  channel.Flow.Seq = number;
  channel.Flow.Heard = number;
  channel.Flow.Idle = 0;
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

// Answers a request without the state machine of the server. Returns false if that has to process it; found: object of
// the request, if it was found.
[[gnu::always_inline]] inline bool answer_at_once(CO_SDO& channel, const CO_IF_FRM& frame, CO_OBJ*& found) {
  if (state_of(channel) != State::idle) {
    return answer_segment(channel, frame);
  }
  if (!initiates_number(frame.Data[0])) {
    return false;
  }
  found = find_number(channel, frame);
  return found == nullptr || answer_number(channel, frame, *found);
}

}  // namespace co::sdo::server
