// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

Abort longer_upload(CO_SDO& channel, CO_OBJ& obj, bool by_block, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  const bool value = is_value(channel, obj);
  if (value) {
    set(channel, whole);
  }
  continue_transfer(channel, obj, by_block ? State::block_upload_ready : State::upload);
  const Abort abort = begin_data(channel, obj, channel.Value, value ? channel.Size : 0);
  if (abort != Abort::none) {
    return abort;
  }
  const bool sized = !obj::is_unknown(channel.Size);
  wire::put_reply(answer, by_block ? wire::initiate_block(sized) : wire::initiate_upload_response(sized), request);
  wire::put_high(answer, sized ? channel.Size : 0);
  if (has_block && by_block) {
    begin_block_upload(channel, request);
  }
  return Abort::none;
}

Abort initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found, Mode mode) {
  CO_NODE& node = *channel.Node;
  const Opened opened = open(channel, request, CO_OBJ_UPLOAD, found);
  Abort abort = opened.abort;
  if (abort != Abort::none) {
    return abort;
  }
  CO_OBJ& obj = *opened.obj;
  const uint32_t size = access::size(obj, node, 0);
  channel.Size = size;
  if (obj::is_no_size(obj, size)) {
    return access::abort_for(node, CO_ERR_TYPE_RD);
  }
  bool by_block = mode == Mode::block;
  if (has_block && by_block) {
    by_block = is_worth_block(size, request);
    abort = check_block_upload(channel, obj, request);
  }
  if (abort == Abort::none && obj::is_stream(obj)) {
    abort = begin_stream(channel, obj, size);
  }
  if (abort != Abort::none) {
    return abort;
  }
  if (by_block || size - 1 >= wire::expedited_bytes) {
    return longer_upload(channel, obj, by_block, request, answer);
  }
  wire::put_reply(answer, wire::expedited_upload_response(size), request);
  abort = begin_data(channel, obj, answer.Data + 4, size);
  return abort == Abort::none && access::is_begun(channel) ? close(channel, Abort::none) : abort;
}

}  // namespace

Abort initiate_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  return initiate(channel, request, answer, found, Mode::segmented);
}

#if USE_SDO_BLOCK
Abort initiate_block_upload(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ* found) {
  if (!has_buffer(channel)) {
    restart(channel, request);
    return Abort::command;
  }
  return initiate(channel, request, answer, found, Mode::block);
}
#endif

Abort upload_segment(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  Abort abort = check_segment(channel, request);
  if (abort != Abort::none) {
    return abort;
  }
  const uint32_t position = channel.Num;
  const uint32_t left = channel.Size - position;
  abort = transfer_piece(channel, position, answer.Data + 1, left < wire::segment_bytes ? left : wire::segment_bytes);
  if (abort != Abort::none) {
    return abort;
  }
  channel.Num = channel.Read;
  const bool last = channel.Num == channel.Size;
  answer.Data[0] = wire::segment(channel.Flags & toggled, channel.Num - position, last);
  channel.Flags ^= toggled;
  return last ? close(channel, Abort::none) : Abort::none;
}

}  // namespace co::sdo_server
