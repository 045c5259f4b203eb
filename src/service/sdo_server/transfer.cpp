// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

#include "core/count.hpp"
#include "core/timer.hpp"
#include "core/transmit.hpp"
#include "object/stream.hpp"

namespace co::sdo_server {
namespace {

constexpr uint8_t slices = 8;
constexpr uint8_t reminder_slices = 2;

CO_OBJ_TRANSFER direction(const CO_SDO& channel) { return has(channel, download) ? CO_OBJ_DOWNLOAD : CO_OBJ_UPLOAD; }

// False: the transfer has been ended.
bool count_slice(CO_SDO& channel) {
  channel.Idle = has(channel, busy) ? 1 : static_cast<uint8_t>(channel.Idle + 1);
  if (channel.Idle == slices) {
    send_abort(channel, channel.Key, CO_SDO_ERR_TIMEOUT);
    close(channel, CO_SDO_ERR_TIMEOUT);
    return false;
  }
  return USE_SDO_BLOCK == 0 || channel.Idle % reminder_slices != 0 || remind(channel);
}

void on_slice(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  bool any_open = false;
  for (CO_SDO& channel : node.Sdo) {
    any_open |= state_of(channel) != State::idle && count_slice(channel);
  }
  if (!any_open) {
    tmr::stop(node.Tmr, node.SdoTmr);
  }
}

// Numbers lie in the byte order of the CPU in type functions, and in that of the bus everywhere else here.
void swap_value(const CO_SDO& channel, uint8_t* value, uint32_t n) {
  if (!obj::is_stream(*channel.Obj)) {
    wire::swap_host(value, n);
  }
}

// The position of our own streams is set before each piece: the application may have used it in between. Types of the
// application are reset at the beginning, and when an upload goes back.
CO_ERR seek_piece(CO_SDO& channel, uint32_t position) {
  const bool own = channel.Obj->Type->Reset == stream::reset;
  return own || position != channel.Read ? obj::seek(*channel.Obj, *channel.Node, position) : CO_ERR_NONE;
}

// A type that did not know its size may know it after a read, which may have filled only a part.
uint32_t learn_size(CO_SDO& channel, uint32_t position, uint32_t& n) {
  if (channel.Size != CO_OBJ_SIZE_UNKNOWN) {
    return no_abort;
  }
  const uint32_t size = obj::size(*channel.Obj, *channel.Node, 0);
  if (size == CO_OBJ_SIZE_UNKNOWN) {
    return no_abort;
  }
  if (size < position) {
    return CO_SDO_ERR_INTERNAL;
  }
  channel.Size = size;
  n = n < size - position ? n : size - position;
  return no_abort;
}

uint32_t begin(CO_SDO& channel, uint32_t size) {
  if (obj::extended(*channel.Obj) == nullptr) {
    return no_abort;
  }
  const CO_ERR err = obj::begin(*channel.Obj, *channel.Node, direction(channel), size);
  if (err != CO_ERR_NONE) {
    return access::abort_for(*channel.Node, err);
  }
  set(channel, begun);
  return no_abort;
}

uint32_t choose_access(Step& step, bool fits_one_frame) {
  CO_SDO& channel = step.channel;
  const bool stream = obj::is_stream(*channel.Obj);
  if (fits_one_frame || (!stream && channel.Size <= sizeof channel.Value)) {
    set(channel, whole);
  }
  return stream && access::is_taken(step.node, *channel.Obj, &channel) ? CO_SDO_ERR_TOS_STATE : no_abort;
}

uint32_t tell_end(const CO_SDO& channel, CO_OBJ& obj, uint32_t code) {
  CO_NODE& node = *channel.Node;
  access::serve(node, &obj);
  const CO_ERR err = obj::end(obj, node, direction(channel), code);
  const bool refused = err != CO_ERR_NONE && code == no_abort && has(channel, download);
  const uint32_t abort = refused ? access::write_failed(node, err) : no_abort;
  node.Served = nullptr;
  return abort;
}

}  // namespace

uint32_t close(CO_SDO& channel, uint32_t code) {
  CO_OBJ* const obj = channel.Obj;
  const bool is_told = has(channel, begun) && !is_gone(channel);
  set_state(channel, State::idle);
  channel.Obj = nullptr;
  clear(channel, begun);
  return is_told ? tell_end(channel, *obj, code) : no_abort;
}

void send_abort(CO_SDO& channel, uint32_t key, uint32_t code) {
  count(channel.Node->Count.SdoAborts);
  transmit::send(*channel.Node, wire::abort_frame(channel.TxId, key, code));
}

// One timer watches all channels: a transfer ends after eight slices without a frame.
void watch(CO_NODE& node) {
  if (tmr::is_running(node.SdoTmr)) {
    return;
  }
  const uint32_t slice = tmr::ticks(node.Tmr, CO_SDO_TIMEOUT, CO_TMR_UNIT_1MS * slices);
  if (slice != 0) {
    tmr::start(node.Tmr, node.SdoTmr, 0, slice, on_slice, &node);
  }
}

bool is_gone(const CO_SDO& channel) {
  const CO_DICT& dict = channel.Node->Dict;
  const auto place = reinterpret_cast<uintptr_t>(channel.Obj) - reinterpret_cast<uintptr_t>(dict.Root);
  return place >= dict.Num * sizeof(CO_OBJ) || CO_GET_DEV(channel.Obj->Key) != channel.Key;
}

uint32_t check_segment(const Step& step) {
  if (is_gone(step.channel)) {
    return CO_SDO_ERR_TOS_STATE;
  }
  return wire::toggle(step.request) != step.channel.Toggle ? CO_SDO_ERR_TBIT : no_abort;
}

uint32_t open(Step& step, CO_OBJ_TRANSFER transfer) {
  CO_SDO& channel = step.channel;
  close(channel, CO_SDO_ERR_TOS_STATE);
  channel.Key = wire::multiplexer(step.request);
  channel.Num = 0;
  channel.Read = 0;
  channel.Toggle = 0;
  channel.Flags = static_cast<uint8_t>(busy | (transfer == CO_OBJ_DOWNLOAD ? download : 0));
  return access::open(step.node, channel.Key, transfer, channel.Obj);
}

uint32_t begin_upload(Step& step, bool fits_one_frame) {
  CO_SDO& channel = step.channel;
  uint32_t abort = choose_access(step, fits_one_frame);
  if (abort == no_abort) {
    abort = begin(channel, channel.Size);
  }
  if (abort != no_abort) {
    return abort;
  }
  const CO_ERR err = has(channel, whole) ? read_whole(channel, channel.Size)
                                         : COObjRdBufStart(channel.Obj, channel.Node, channel.Value, 0);
  return err == CO_ERR_NONE ? no_abort : access::read_failed(step.node, err);
}

uint32_t begin_download(Step& step, uint32_t size, bool fits_one_frame) {
  CO_SDO& channel = step.channel;
  const uint32_t abort = choose_access(step, fits_one_frame);
  return abort == no_abort ? begin(channel, size) : abort;
}

uint32_t start_writing(CO_SDO& channel) {
  if (has(channel, whole)) {
    return no_abort;
  }
  const CO_ERR err = COObjWrBufStart(channel.Obj, channel.Node, channel.Value, 0);
  return err == CO_ERR_NONE ? no_abort : access::write_failed(*channel.Node, err);
}

CO_ERR read_whole(CO_SDO& channel, uint32_t n) {
  CO_ERR err = obj::seek(*channel.Obj, *channel.Node, 0);
  if (err == CO_ERR_NONE) {
    err = obj::read(*channel.Obj, *channel.Node, channel.Value, n);
    swap_value(channel, channel.Value, n);
  }
  return err;
}

CO_ERR write_whole(CO_SDO& channel, uint32_t n) {
  const CO_ERR err = obj::seek(*channel.Obj, *channel.Node, 0);
  if (err != CO_ERR_NONE) {
    return err;
  }
  swap_value(channel, channel.Value, n);
  return obj::write(*channel.Obj, *channel.Node, channel.Value, n);
}

uint32_t get(CO_SDO& channel, uint32_t position, uint8_t* to, uint32_t& n) {
  if (has(channel, whole)) {
    __builtin_memcpy(to, channel.Value + position, n);
    return no_abort;
  }
  if (n == 0) {
    return no_abort;
  }
  CO_ERR err = seek_piece(channel, position);
  if (err == CO_ERR_NONE) {
    err = obj::read(*channel.Obj, *channel.Node, to, n);
  }
  const uint32_t abort =
      err == CO_ERR_NONE ? learn_size(channel, position, n) : access::read_failed(*channel.Node, err);
  channel.Read = position + n;
  return abort;
}

uint32_t put(CO_SDO& channel, uint8_t* from, uint32_t n) {
  CO_ERR err = CO_ERR_NONE;
  if (has(channel, whole)) {
    __builtin_memcpy(channel.Value + channel.Num, from, n);
  } else if (n != 0) {
    err = seek_piece(channel, channel.Num);
    if (err == CO_ERR_NONE) {
      err = obj::write(*channel.Obj, *channel.Node, from, n);
    }
  }
  channel.Num += n;
  channel.Read = channel.Num;
  return err == CO_ERR_NONE ? no_abort : access::write_failed(*channel.Node, err);
}

}  // namespace co::sdo_server
