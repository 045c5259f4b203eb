// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

// The object is read at once when it is sent, or kept, as a whole; else it is opened.
CO_ERR prepare_upload(CO_SDO& channel) {
  return (channel.Flags & whole) != 0 ? read_whole(channel, channel.Size) : begin_reading(channel);
}

void answer_expedited(Step& step) {
  CO_SDO& channel = step.channel;
  wire::put_head(step.answer, wire::expedited_upload_response(channel.Size), channel.Key);
  for (uint32_t n = 0; n < channel.Size; ++n) {
    step.answer.Data[4 + n] = channel.Value[n];
  }
  close(channel);
}

}  // namespace

uint32_t initiate_upload(Step& step) {
  const auto can_read = [](const CO_OBJ_TYPE& type) { return type.Read != nullptr; };
  uint32_t abort = open(step, CO_OBJ_____R_, can_read, CO_SDO_ERR_RD);
  if (abort != no_abort) {
    return abort;
  }
  CO_SDO& channel = step.channel;
  channel.Size = obj::size(*channel.Obj, step.node, 0);
  if (channel.Size == 0 && !obj::is_stream(*channel.Obj)) {
    return abort_for(channel, CO_ERR_TYPE_RD);
  }
  const bool expedited = channel.Size != 0 && channel.Size <= wire::expedited_bytes;
  abort = choose_access(step, expedited);
  if (abort != no_abort) {
    return abort;
  }
  const CO_ERR err = prepare_upload(channel);
  if (err != CO_ERR_NONE) {
    return read_failed(channel, err);
  }
  if (expedited) {
    answer_expedited(step);
    return no_abort;
  }
  wire::put_head(step.answer, wire::initiate_upload_response_sized, channel.Key);
  wire::put_u32(step.answer.Data + 4, channel.Size);
  set_state(channel, State::upload);
  return no_abort;
}

namespace {

CO_ERR give_segment(CO_SDO& channel, uint8_t* data, uint32_t n) {
  if ((channel.Flags & whole) != 0) {
    __builtin_memcpy(data, channel.Value + channel.Num, n);
    return CO_ERR_NONE;
  }
  return n == 0 ? CO_ERR_NONE : read_piece(channel, data, n);
}

}  // namespace

uint32_t upload_segment(Step& step) {
  CO_SDO& channel = step.channel;
  const uint32_t abort = check_segment(step);
  if (abort != no_abort) {
    return abort;
  }
  const uint32_t left = channel.Size - channel.Num;
  const uint32_t n = left < wire::segment_bytes ? left : wire::segment_bytes;
  const CO_ERR err = give_segment(channel, step.answer.Data + 1, n);
  if (err != CO_ERR_NONE) {
    return read_failed(channel, err);
  }
  step.answer.Data[0] = wire::upload_segment_response(channel.Toggle, n, n == left);
  channel.Num += n;
  channel.Toggle ^= wire::toggle_bit;
  if (n == left) {
    close(channel);
  }
  return no_abort;
}

}  // namespace co::sdo_server
