// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

namespace co::sdo_server {
namespace {

// need: the length nearest to the client's that the object can have.
uint32_t compare_length(uint32_t length, uint32_t need) {
  if (length == need) {
    return no_abort;
  }
  return length > need ? CO_SDO_ERR_LEN_HIGH : CO_SDO_ERR_LEN_SMALL;
}

// A stream may always be emptied.
uint32_t check_length(Step& step, uint32_t length) {
  CO_OBJ& obj = *step.channel.Obj;
  if (length == 0 && obj::is_stream(obj)) {
    return no_abort;
  }
  const uint32_t need = obj::size(obj, step.node, length);
  const bool failed = need == 0 && !obj::is_stream(obj);
  return failed ? abort_for(step.channel, CO_ERR_TYPE_WR) : compare_length(length, need);
}

// Bytes that a download can have when the client does not say how many.
uint32_t capacity(Step& step) {
  CO_OBJ& obj = *step.channel.Obj;
  return obj::size(obj, step.node, obj::is_stream(obj) ? UINT32_MAX : 0);
}

uint32_t expedited_download(Step& step) {
  CO_SDO& channel = step.channel;
  const uint8_t command = step.request.Data[0];
  uint32_t length = wire::expedited_length(command);
  if (!wire::is_size_indicated(command)) {
    length = capacity(step);
  }
  if (length > wire::expedited_bytes) {
    return CO_SDO_ERR_LEN;
  }
  uint32_t abort = check_length(step, length);
  if (abort == no_abort) {
    abort = choose_access(step, true);
  }
  if (abort != no_abort) {
    return abort;
  }
  __builtin_memcpy(channel.Value, step.request.Data + 4, wire::expedited_bytes);
  const CO_ERR err = write_whole(channel, length);
  if (err != CO_ERR_NONE) {
    return write_failed(channel, err);
  }
  close(channel);
  return no_abort;
}

// Sets Size to what will come, or may come at most.
uint32_t announce(Step& step) {
  CO_SDO& channel = step.channel;
  if (wire::is_size_indicated(step.request.Data[0])) {
    channel.Flags |= sized;
    channel.Size = wire::get_u32(step.request.Data + 4);
    return check_length(step, channel.Size);
  }
  channel.Size = capacity(step);
  const bool failed = channel.Size == 0 && !obj::is_stream(*channel.Obj);
  return failed ? abort_for(channel, CO_ERR_TYPE_WR) : no_abort;
}

uint32_t segmented_download(Step& step) {
  CO_SDO& channel = step.channel;
  uint32_t abort = announce(step);
  if (abort == no_abort) {
    abort = choose_access(step, false);
  }
  if (abort != no_abort) {
    return abort;
  }
  if ((channel.Flags & whole) == 0) {
    const CO_ERR err = begin_writing(channel);
    if (err != CO_ERR_NONE) {
      return write_failed(channel, err);
    }
  }
  set_state(channel, State::download);
  return no_abort;
}

}  // namespace

uint32_t initiate_download(Step& step) {
  const auto can_write = [](const CO_OBJ_TYPE& type) { return type.Write != nullptr; };
  const uint32_t abort = open(step, CO_OBJ______W, can_write, CO_SDO_ERR_WR);
  if (abort != no_abort) {
    return abort;
  }
  wire::put_head(step.answer, wire::initiate_download_response, step.channel.Key);
  return wire::is_expedited(step.request.Data[0]) ? expedited_download(step) : segmented_download(step);
}

namespace {

CO_ERR take_segment(CO_SDO& channel, const uint8_t* data, uint32_t n) {
  if ((channel.Flags & whole) != 0) {
    __builtin_memcpy(channel.Value + channel.Num, data, n);
    return CO_ERR_NONE;
  }
  uint8_t piece[wire::segment_bytes];
  __builtin_memcpy(piece, data, sizeof piece);
  return n == 0 ? CO_ERR_NONE : write_piece(channel, piece, n);
}

uint32_t end_download(Step& step) {
  CO_SDO& channel = step.channel;
  const uint32_t abort =
      (channel.Flags & sized) != 0 ? compare_length(channel.Num, channel.Size) : check_length(step, channel.Num);
  if (abort != no_abort) {
    return abort;
  }
  if ((channel.Flags & whole) != 0) {
    const CO_ERR err = write_whole(channel, channel.Num);
    if (err != CO_ERR_NONE) {
      return write_failed(channel, err);
    }
  }
  close(channel);
  return no_abort;
}

}  // namespace

uint32_t download_segment(Step& step) {
  CO_SDO& channel = step.channel;
  const uint8_t command = step.request.Data[0];
  const uint32_t abort = check_segment(step);
  if (abort != no_abort) {
    return abort;
  }
  const uint32_t n = wire::segment_length(command);
  if (n > channel.Size - channel.Num) {
    return CO_SDO_ERR_LEN_HIGH;
  }
  const CO_ERR err = take_segment(channel, step.request.Data + 1, n);
  if (err != CO_ERR_NONE) {
    return write_failed(channel, err);
  }
  channel.Num += n;
  step.answer.Data[0] = wire::download_segment_response(channel.Toggle);
  channel.Toggle ^= wire::toggle_bit;
  return wire::is_last_segment(command) ? end_download(step) : no_abort;
}

}  // namespace co::sdo_server
