// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

#include "co_assert.h"

namespace co::sdo_server {
namespace {

// Returns the maximum number of bytes of a download whose size is not announced.
uint32_t capacity(CO_NODE& node, CO_OBJ& obj) { return access::size(obj, node, obj::is_stream(obj) ? UINT32_MAX : 0); }

Abort expedited_download(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request) {
  CO_NODE& node = *channel.Node;
  const uint8_t command = request.Data[0];
  const uint32_t length = wire::is_size_indicated(command) ? wire::expedited_length(command) : capacity(node, obj);
  if (length > wire::expedited_bytes) {
    return Abort::length;
  }
  Abort abort = access::check_length(node, obj, length);
  if (abort == Abort::none && obj::is_stream(obj)) {
    abort = begin_stream(channel, obj, length);
  }
  if (abort != Abort::none) {
    return abort;
  }
  wire::put_aligned(channel.Value, wire::get_high(request));
  abort = begin_data(channel, obj, channel.Value, length);
  return abort == Abort::none && access::is_begun(channel) ? close(channel, Abort::none) : abort;
}

// Sets Size to the announced size, or to the maximum of the object.
Abort take_size(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, bool announced) {
  CO_NODE& node = *channel.Node;
  if (announced) {
    set(channel, sized);
    channel.Size = wire::get_high(request);
    return access::check_length(node, obj, channel.Size);
  }
  channel.Size = capacity(node, obj);
  return channel.Size == 0 && !obj::is_stream(obj) ? access::abort_for(node, CO_ERR_TYPE_WR) : Abort::none;
}

Abort longer_download(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, CO_IF_FRM& answer, Mode mode) {
  const uint8_t command = request.Data[0];
  const bool announced = mode == Mode::block ? wire::is_block_sized(command) : wire::is_size_indicated(command);
  Abort abort = take_size(channel, obj, request, announced);
  if (abort == Abort::none && obj::is_stream(obj)) {
    abort = begin_stream(channel, obj, announced ? channel.Size : CO_OBJ_SIZE_UNKNOWN);
  }
  if (abort != Abort::none) {
    return abort;
  }
  if (is_value(channel, obj)) {
    set(channel, whole);
  }
  continue_transfer(channel, obj, mode == Mode::block ? State::block_download : State::download);
  if (has_block && mode == Mode::block) {
    begin_block_download(channel, request, answer);
    return Abort::none;
  }
  return has(channel, whole) ? Abort::none : begin_data(channel, obj, channel.Value, 0);
}

Abort initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found, Mode mode) {
  const Opened opened = open(channel, request, CO_OBJ_DOWNLOAD, found);
  if (opened.abort != Abort::none) {
    return opened.abort;
  }
  CO_OBJ& obj = *opened.obj;
  wire::put_reply(answer, mode == Mode::block ? wire::accept_block : wire::initiate_download_response, request);
  return mode != Mode::block && wire::is_expedited(request.Data[0])
             ? expedited_download(channel, obj, request)
             : longer_download(channel, obj, request, answer, mode);
}

}  // namespace

Abort initiate_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  return initiate(channel, request, answer, found, Mode::segmented);
}

#if USE_SDO_BLOCK
Abort initiate_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  if (!has_buffer(channel)) {
    restart(channel, request);
    return Abort::command;
  }
  return initiate(channel, request, answer, found, Mode::block);
}
#endif

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
