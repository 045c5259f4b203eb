// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

#include "co_assert.h"

namespace co::sdo_server {
namespace {

// Returns the maximum number of bytes of a download whose size is not announced.
uint32_t capacity(CO_NODE& node, CO_OBJ& obj) { return access::size(obj, node, obj::is_stream(obj) ? UINT32_MAX : 0); }

uint32_t expedited_download(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request) {
  CO_NODE& node = *channel.Node;
  const uint8_t command = request.Data[0];
  const uint32_t length = wire::is_size_indicated(command) ? wire::expedited_length(command) : capacity(node, obj);
  if (length > wire::expedited_bytes) {
    return CO_SDO_ERR_LEN;
  }
  uint32_t abort = access::check_length(node, obj, length);
  if (abort == no_abort && obj::is_stream(obj)) {
    abort = begin_stream(channel, obj, length);
  }
  if (abort != no_abort) {
    return abort;
  }
  wire::put_aligned(channel.Value, wire::get_high(request));
  abort = begin_data(channel, obj, channel.Value, length);
  return abort == no_abort && access::is_begun(channel) ? close(channel, no_abort) : abort;
}

// Sets Size to the announced size, or to the maximum of the object.
uint32_t take_size(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, bool announced) {
  CO_NODE& node = *channel.Node;
  if (announced) {
    set(channel, sized);
    channel.Size = wire::get_high(request);
    return access::check_length(node, obj, channel.Size);
  }
  channel.Size = capacity(node, obj);
  return channel.Size == 0 && !obj::is_stream(obj) ? access::abort_for(node, CO_ERR_TYPE_WR) : no_abort;
}

uint32_t longer_download(CO_SDO& channel, CO_OBJ& obj, const CO_IF_FRM& request, CO_IF_FRM& answer, Mode mode) {
  const uint8_t command = request.Data[0];
  const bool announced = mode == Mode::block ? wire::is_block_sized(command) : wire::is_size_indicated(command);
  uint32_t abort = take_size(channel, obj, request, announced);
  if (abort == no_abort && obj::is_stream(obj)) {
    abort = begin_stream(channel, obj, announced ? channel.Size : CO_OBJ_SIZE_UNKNOWN);
  }
  if (abort != no_abort) {
    return abort;
  }
  if (is_value(channel, obj)) {
    set(channel, whole);
  }
  continue_transfer(channel, obj, mode == Mode::block ? State::block_download : State::download);
  if (has_block && mode == Mode::block) {
    begin_block_download(channel, request, answer);
    return no_abort;
  }
  return has(channel, whole) ? no_abort : begin_data(channel, obj, channel.Value, 0);
}

uint32_t initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found, Mode mode) {
  const Opened opened = open(channel, request, CO_OBJ_DOWNLOAD, found);
  if (opened.abort != no_abort) {
    return opened.abort;
  }
  CO_OBJ& obj = *opened.obj;
  wire::put_reply(answer, mode == Mode::block ? wire::accept_block : wire::initiate_download_response, request);
  return mode != Mode::block && wire::is_expedited(request.Data[0])
             ? expedited_download(channel, obj, request)
             : longer_download(channel, obj, request, answer, mode);
}

}  // namespace

uint32_t initiate_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  return initiate(channel, request, answer, found, Mode::segmented);
}

#if USE_SDO_BLOCK
uint32_t initiate_block_download(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  if (!has_buffer(channel)) {
    restart(channel, request);
    return CO_SDO_ERR_CMD;
  }
  return initiate(channel, request, answer, found, Mode::block);
}
#endif

uint32_t check_total(CO_SDO& channel, uint32_t total) {
  if (total > channel.Size) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  if (channel.Obj == nullptr) {
    return CO_SDO_ERR_TOS_STATE;
  }
  return has(channel, sized) ? access::compare_length(total, channel.Size)
                             : access::check_length(*channel.Node, *channel.Obj, total);
}

uint32_t finish_download(CO_SDO& channel) {
  CO_ASSERT(!has(channel, whole) || channel.Obj != nullptr);
  const uint32_t abort = has(channel, whole) ? begin_data(channel, *channel.Obj, channel.Value, channel.Num) : no_abort;
  return abort == no_abort ? close(channel, no_abort) : abort;
}

uint32_t download_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  const uint8_t command = request.Data[0];
  uint32_t abort = check_segment(channel, request);
  if (abort != no_abort) {
    return abort;
  }
  const uint32_t left = channel.Size - channel.Num;
  const uint32_t n = has(channel, sized) ? wire::segment_length(command, left) : wire::segment_length(command);
  if (n > left) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  if (wire::is_last_segment(command)) {
    set_total(channel, n);
  }
  CO_IF_FRM segment = request;  // a copy, because a type function may change its buffer
  abort = transfer_piece(channel, channel.Num, segment.Data + 1, n);
  channel.Num = channel.Read;
  answer.Data[0] = wire::download_segment_response(channel.Flags & toggled);
  channel.Flags ^= toggled;
  if (abort != no_abort || !wire::is_last_segment(command)) {
    return abort;
  }
  abort = check_total(channel, channel.Num);
  return abort == no_abort ? finish_download(channel) : abort;
}

}  // namespace co::sdo_server
