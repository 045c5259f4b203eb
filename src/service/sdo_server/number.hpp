// SPDX-License-Identifier: Apache-2.0
// Expedited transfers of numbers that their variables hold as the bus transfers them. They call no type function and
// leave no state, so the server answers them at once.
#pragma once

#include "base/access_hook.hpp"
#include "base/events.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/number.hpp"
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {

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
  constexpr uint8_t length = 0x0C;
  return command == wire::initiate_upload_request || (command & ~length) == wire::expedited_download_request(4);
}

// Returns the object of a request that may initiate the transfer of a number, otherwise null. No transfer is open.
inline CO_OBJ* find_number(const CO_SDO& channel, const CO_IF_FRM& request) {
  const bool is_enabled = USE_FAST_PATHS != 0 && wire::host_is_little_endian;
  if (!is_enabled || !initiates_number(request.Data[0])) {
    return nullptr;
  }
  return dict::find(*channel.Node, wire::multiplexer(request));
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

}  // namespace co::sdo_server
