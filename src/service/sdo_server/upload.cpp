// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

void answer_expedited(Step& step) {
  CO_SDO& channel = step.channel;
  wire::put_head(step.answer, wire::expedited_upload_response(channel.Size), channel.Key);
  __builtin_memcpy(step.answer.Data + 4, channel.Value, wire::expedited_bytes);
  close(channel, no_abort);
}

}  // namespace

void answer_size(const CO_SDO& channel, uint8_t command, CO_IF_FRM& answer) {
  wire::put_head(answer, command, channel.Key);
  wire::put_high(answer, channel.Size == CO_OBJ_SIZE_UNKNOWN ? 0 : channel.Size);
}

uint32_t open_upload(Step& step) {
  CO_SDO& channel = step.channel;
  const uint32_t abort = open(step, CO_OBJ_UPLOAD);
  if (abort != no_abort) {
    return abort;
  }
  channel.Size = obj::size(*channel.Obj, step.node, 0);
  const bool failed = channel.Size == 0 && !obj::is_stream(*channel.Obj);
  return failed ? access::abort_for(step.node, CO_ERR_TYPE_RD) : no_abort;
}

uint32_t ordinary_upload(Step& step) {
  CO_SDO& channel = step.channel;
  const bool expedited = channel.Size != 0 && channel.Size <= wire::expedited_bytes;
  __builtin_memset(channel.Value, 0, wire::expedited_bytes);
  const uint32_t abort = begin_upload(step, expedited);
  if (abort != no_abort) {
    return abort;
  }
  if (expedited) {
    answer_expedited(step);
  } else {
    answer_size(channel, wire::initiate_upload_response(channel.Size != CO_OBJ_SIZE_UNKNOWN), step.answer);
    set_state(channel, State::upload);
  }
  return no_abort;
}

uint32_t initiate_upload(Step& step) {
  const uint32_t abort = open_upload(step);
  return abort == no_abort ? ordinary_upload(step) : abort;
}

uint32_t upload_segment(Step& step) {
  CO_SDO& channel = step.channel;
  uint32_t abort = check_segment(step);
  if (abort != no_abort) {
    return abort;
  }
  const uint32_t left = channel.Size - channel.Num;
  uint32_t n = left < wire::segment_bytes ? left : wire::segment_bytes;
  abort = get(channel, channel.Num, step.answer.Data + 1, n);
  if (abort != no_abort) {
    return abort;
  }
  channel.Num += n;
  const bool last = channel.Num == channel.Size;
  step.answer.Data[0] = wire::segment(channel.Toggle, n, last);
  channel.Toggle ^= wire::toggle_bit;
  if (last) {
    close(channel, no_abort);
  }
  return no_abort;
}

}  // namespace co::sdo_server
