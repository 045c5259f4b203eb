// SPDX-License-Identifier: Apache-2.0
// Segmented transfer, and the end of every download. [301:7.2.4.3.4, 7.2.4.3.7]
#include "service/sdo_server/transfer.hpp"

#include "co_assert.h"

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
