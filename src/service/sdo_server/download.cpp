// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

// Bytes that a download can have when the client does not say how many.
uint32_t capacity(const Step& step) {
  CO_OBJ& obj = *step.channel.Obj;
  return obj::size(obj, step.node, obj::is_stream(obj) ? UINT32_MAX : 0);
}

uint32_t expedited_download(Step& step) {
  CO_SDO& channel = step.channel;
  const uint8_t command = step.request.Data[0];
  const uint32_t length = wire::is_size_indicated(command) ? wire::expedited_length(command) : capacity(step);
  if (length > wire::expedited_bytes) {
    return CO_SDO_ERR_LEN;
  }
  uint32_t abort = access::check_length(step.node, *channel.Obj, length);
  if (abort == no_abort) {
    abort = begin_download(step, length, true);
  }
  if (abort != no_abort) {
    return abort;
  }
  __builtin_memcpy(channel.Value, step.request.Data + 4, wire::expedited_bytes);
  channel.Num = length;
  return finish_download(step);
}

uint32_t segmented_download(Step& step) {
  const uint32_t abort = open_download(step, wire::is_size_indicated(step.request.Data[0]));
  if (abort != no_abort) {
    return abort;
  }
  set_state(step.channel, State::download);
  return start_writing(step.channel);
}

}  // namespace

uint32_t initiate_download(Step& step) {
  const uint32_t abort = open(step, CO_OBJ_DOWNLOAD);
  if (abort != no_abort) {
    return abort;
  }
  wire::put_head(step.answer, wire::initiate_download_response, step.channel.Key);
  return wire::is_expedited(step.request.Data[0]) ? expedited_download(step) : segmented_download(step);
}

uint32_t open_download(Step& step, bool announced) {
  CO_SDO& channel = step.channel;
  uint32_t abort = no_abort;
  if (announced) {
    set(channel, sized);
    channel.Size = wire::get_high(step.request);
    abort = access::check_length(step.node, *channel.Obj, channel.Size);
  } else {
    channel.Size = capacity(step);
    const bool failed = channel.Size == 0 && !obj::is_stream(*channel.Obj);
    abort = failed ? access::abort_for(step.node, CO_ERR_TYPE_WR) : no_abort;
  }
  return abort == no_abort ? begin_download(step, announced ? channel.Size : CO_OBJ_SIZE_UNKNOWN, false) : abort;
}

uint32_t check_total(Step& step, uint32_t total) {
  const CO_SDO& channel = step.channel;
  if (total > channel.Size) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  return has(channel, sized) ? access::compare_length(total, channel.Size)
                             : access::check_length(step.node, *channel.Obj, total);
}

uint32_t finish_download(Step& step) {
  CO_SDO& channel = step.channel;
  if (has(channel, whole)) {
    const CO_ERR err = write_whole(channel, channel.Num);
    if (err != CO_ERR_NONE) {
      return access::write_failed(step.node, err);
    }
  }
  return close(channel, no_abort);
}

uint32_t download_segment(Step& step) {
  CO_SDO& channel = step.channel;
  const uint8_t command = step.request.Data[0];
  uint32_t abort = check_segment(step);
  if (abort != no_abort) {
    return abort;
  }
  const uint32_t n = wire::segment_length(command);
  if (n > channel.Size - channel.Num) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  uint8_t piece[wire::segment_bytes];
  __builtin_memcpy(piece, step.request.Data + 1, sizeof piece);
  abort = put(channel, piece, n);
  step.answer.Data[0] = wire::download_segment_response(channel.Toggle);
  channel.Toggle ^= wire::toggle_bit;
  if (abort != no_abort || !wire::is_last_segment(command)) {
    return abort;
  }
  abort = check_total(step, channel.Num);
  return abort == no_abort ? finish_download(step) : abort;
}

}  // namespace co::sdo_server
