// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/transfer.hpp"

#include "core/abort_code.hpp"
#include "core/count.hpp"
#include "core/dict.hpp"
#include "core/timer.hpp"
#include "core/transmit.hpp"
#include "object/stream.hpp"

namespace co::sdo_server {
namespace {

constexpr uint8_t slices = 8;

void on_slice(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  bool any_open = false;
  for (CO_SDO& channel : node.Sdo) {
    if (state_of(channel) == State::idle) {
      continue;
    }
    if ((channel.Flags & busy) != 0) {
      channel.Idle = 0;
    }
    if (++channel.Idle == slices) {
      close(channel);
      send_abort(channel, channel.Key, CO_SDO_ERR_TIMEOUT);
    } else {
      any_open = true;
    }
  }
  if (!any_open) {
    tmr::stop(node.Tmr, node.SdoTmr);
  }
}

// Another channel has the position of this stream.
bool is_taken(const CO_NODE& node, const CO_SDO& by, const CO_OBJ& obj) {
  for (const CO_SDO& other : node.Sdo) {
    if (&other != &by && other.Obj == &obj && (other.Flags & whole) == 0) {
      return true;
    }
  }
  return false;
}

// Numbers lie in the byte order of the CPU in type functions, and in that of the bus everywhere else here.
void swap_value(const CO_SDO& channel, uint8_t* value, uint32_t n) {
  if (!obj::is_stream(*channel.Obj)) {
    wire::swap_host(value, n);
  }
}

// The position of our own streams is set before each piece: the application may have used it in between. Types of the
// application are reset once, at the beginning.
CO_ERR seek_piece(CO_SDO& channel) {
  const bool own = channel.Obj->Type->Reset == stream::reset;
  return own ? obj::seek(*channel.Obj, *channel.Node, channel.Num) : CO_ERR_NONE;
}

// The table may have been changed, or replaced by another, since the transfer began.
bool is_gone(const CO_SDO& channel) {
  const CO_DICT& dict = channel.Node->Dict;
  const auto place = reinterpret_cast<uintptr_t>(channel.Obj) - reinterpret_cast<uintptr_t>(dict.Root);
  return place >= dict.Num * sizeof(CO_OBJ) || CO_GET_DEV(channel.Obj->Key) != channel.Key;
}

}  // namespace

void close(CO_SDO& channel) {
  set_state(channel, State::idle);
  channel.Obj = nullptr;
}

void send_abort(CO_SDO& channel, uint32_t key, uint32_t code) {
  CO_IF_FRM frame = {channel.TxId, {}, wire::sdo_dlc};
  wire::put_head(frame, wire::abort_command, key);
  wire::put_u32(frame.Data + 4, code);
  count(channel.Node->Count.SdoAborts);
  transmit::send(*channel.Node, frame);
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

uint32_t check_segment(const Step& step) {
  if (is_gone(step.channel)) {
    return CO_SDO_ERR_TOS_STATE;
  }
  return wire::toggle(step.request) != step.channel.Toggle ? CO_SDO_ERR_TBIT : no_abort;
}

uint32_t abort_for(const CO_SDO& channel, CO_ERR err) {
  return channel.UserAbort != 0 ? channel.UserAbort : abort_code(err);
}

uint32_t read_failed(const CO_SDO& channel, CO_ERR err) {
  channel.Node->Error = CO_ERR_SDO_READ;
  return abort_for(channel, err);
}

uint32_t write_failed(const CO_SDO& channel, CO_ERR err) {
  channel.Node->Error = CO_ERR_SDO_WRITE;
  return abort_for(channel, err);
}

uint32_t open(Step& step, uint32_t right, bool (*can)(const CO_OBJ_TYPE&), uint32_t refused) {
  CO_SDO& channel = step.channel;
  close(channel);
  channel.Key = wire::multiplexer(step.request);
  channel.Num = 0;
  channel.Toggle = 0;
  channel.Idle = 0;
  channel.Flags = busy;
  CO_OBJ* const obj = CODictFind(&step.node.Dict, channel.Key);
  if (obj == nullptr) {
    return dict::has_index(step.node.Dict, channel.Key) ? CO_SDO_ERR_SUB : CO_SDO_ERR_OBJ;
  }
  if ((obj->Key & right) == 0 || !can(*obj->Type)) {
    return (obj->Key & CO_OBJ_____RW) == 0 ? CO_SDO_ERR_UNSUP : refused;
  }
  if (obj->Type->Size == nullptr) {
    return CO_SDO_ERR_TOS;
  }
  channel.Obj = obj;
  return no_abort;
}

uint32_t choose_access(Step& step, bool fits_one_frame) {
  CO_SDO& channel = step.channel;
  const bool stream = obj::is_stream(*channel.Obj);
  if (fits_one_frame || (!stream && channel.Size <= sizeof channel.Value)) {
    channel.Flags |= whole;
  }
  return stream && is_taken(step.node, channel, *channel.Obj) ? CO_SDO_ERR_TOS_STATE : no_abort;
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

CO_ERR begin_reading(CO_SDO& channel) { return COObjRdBufStart(channel.Obj, channel.Node, channel.Value, 0); }

CO_ERR begin_writing(CO_SDO& channel) { return COObjWrBufStart(channel.Obj, channel.Node, channel.Value, 0); }

CO_ERR read_piece(CO_SDO& channel, uint8_t* to, uint32_t n) {
  const CO_ERR err = seek_piece(channel);
  return err != CO_ERR_NONE ? err : obj::read(*channel.Obj, *channel.Node, to, n);
}

CO_ERR write_piece(CO_SDO& channel, uint8_t* from, uint32_t n) {
  const CO_ERR err = seek_piece(channel);
  return err != CO_ERR_NONE ? err : obj::write(*channel.Obj, *channel.Node, from, n);
}

}  // namespace co::sdo_server
