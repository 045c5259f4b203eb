// SPDX-License-Identifier: Apache-2.0
#include "service/sdo/server.hpp"

#include "base/access_hook.hpp"
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/types/stream.hpp"

namespace co::sdo::server {
namespace {

constexpr bool has_time_out = CO_SDO_TIMEOUT != 0;

// The time-out consists of 8 slices, counted in CO_SDO.Flow.Idle. A block download repeats its acknowledge after every
// second slice without a segment.
constexpr uint8_t slices = 8;
constexpr uint8_t reminder_slices = 2;

using access::direction_of;

// Counts an elapsed slice of an open transfer; each frame of the transfer sets the counter to 0.
void count_slice(CO_SDO& channel) {
  if (state_of(channel) == State::idle) {
    return;
  }
  ++channel.Flow.Idle;
  if (channel.Flow.Idle == slices) {
    abort_transfer(channel, Abort::time_out);
  } else if (has_block && channel.Flow.Idle % reminder_slices == 0) {
    handle_silence(channel);
  }
}

void on_slice(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  for (CO_SDO& channel : node.Sdo) {
    count_slice(channel);
  }
  stop_idle_timer(node);
}

// Sets the position of a piece. Positions of library streams are set before each piece, because the application may
// have used the object in between. Types of the application keep their position: their Reset function is called at the
// beginning (begin_data()), and here when a block upload repeats segments that the client has lost.
[[gnu::always_inline]] inline CO_ERR seek_piece(const CO_SDO& channel, CO_OBJ& obj, uint32_t position) {
  if (obj.Type->Reset == stream::reset) {
    return stream::seek(obj, position);
  }
  return position != channel.Read ? obj::seek(obj, *channel.Node, position) : CO_ERR_NONE;
}

// Whether a type function may end its transfer: by the removal of an extension.
constexpr bool may_end_itself = USE_OD != 0;

// Called after each Read of an object of unknown size. Once the Read has reached the end of the object, the type
// reports the size: it becomes the size of the transfer, and limits Read to the bytes that the type has filled in.
Abort learn_size(CO_SDO& channel, uint32_t position) {
  if (may_end_itself && channel.Obj == nullptr) {
    return Abort::device_state;
  }
  const uint32_t size = access::size(*channel.Obj, *channel.Node, 0);
  if (obj::is_unknown(size)) {
    return Abort::none;
  }
  if (size < position) {
    return Abort::internal;
  }
  channel.Flow.Size = size;
  channel.Read = channel.Read < size ? channel.Read : size;
  return Abort::none;
}

// Calls Read or Write; access::check() has checked that the type has the function.
inline CO_ERR call_read_or_write(const CO_SDO& channel, CO_OBJ& obj, uint8_t* data, uint32_t n) {
  CO_NODE& node = *channel.Node;
  if (!has(channel.Flow, download)) {
    return obj.Type->Read(&obj, &node, data, n);
  }
  const CO_ERR err = obj.Type->Write(&obj, &node, data, n);
  if (err == CO_ERR_NONE) {
    event::write_object(node, obj);
  }
  return err;
}

// Calls the type's End function, also after the request or without one (time-out). Returns the error of End as abort
// code, if it is the end of a complete download.
Abort call_end(const CO_SDO& channel, CO_OBJ& obj, Abort code) {
  CO_NODE& node = *channel.Node;
  const access::Request request(node, &obj);
  const CO_ERR err = obj::end(obj, node, direction_of(channel), code);
  const bool refused = err != CO_ERR_NONE && code == Abort::none && has(channel.Flow, download);
  return refused ? access::report_failure(node, CO_OBJ_DOWNLOAD, err) : Abort::none;
}

}  // namespace

Abort close(CO_SDO& channel, Abort code) {
  CO_OBJ* const obj = channel.Obj;
  const bool has_end = access::is_begun(channel) && obj != nullptr;
  set_state(channel, State::idle);
  channel.Obj = nullptr;
  return has_end ? call_end(channel, *obj, code) : Abort::none;
}

void abort_transfer(CO_SDO& channel, Abort code) {
  CO_ASSERT(code != Abort::none);
  count(channel.Node->Count.SdoAborts);
  transmit::send(*channel.Node, wire::abort_frame(channel.TxId, channel.Key, code));
  close(channel, code);
}

// One timer supervises all channels: a transfer ends after eight slices without a frame.
void continue_transfer(CO_SDO& channel, CO_OBJ& obj, State state) {
  CO_NODE& node = *channel.Node;
  CO_ASSERT(state_of(channel) == State::idle && state != State::idle);
  channel.Obj = &obj;
  channel.Flow.Num = 0;
  channel.Read = 0;
  set_state(channel, state);
  if (!has_time_out || tmr::is_running(node.SdoTmr)) {
    return;
  }
  const uint32_t slice = tmr::ticks(node, CO_SDO_TIMEOUT, CO_TMR_UNIT_1MS * slices);
  if (slice != 0) {
    tmr::start(node, node.SdoTmr, 0, slice, on_slice, &node);
  }
}

void stop_idle_timer(CO_NODE& node) {
  if (!has_time_out) {
    return;
  }
  for (const CO_SDO& channel : node.Sdo) {
    if (state_of(channel) != State::idle) {
      return;
    }
  }
  tmr::stop(node, node.SdoTmr);
}

void restart(CO_SDO& channel, const CO_IF_FRM& request) {
  if (state_of(channel) != State::idle) {
    close(channel, Abort::device_state);
  }
  channel.Key = wire::multiplexer(request);
}

Abort begin_stream(CO_SDO& channel, CO_OBJ& obj, uint32_t size) {
  CO_NODE& node = *channel.Node;
  if (access::is_open(node, obj)) {
    return Abort::device_state;
  }
  if (obj::extended(obj) == nullptr) {
    return Abort::none;
  }
  const CO_ERR err = obj::begin(obj, node, direction_of(channel), size);
  if (err != CO_ERR_NONE) {
    return access::abort_for(node, err);
  }
  set(channel.Flow, begun);
  channel.Obj = &obj;
  return Abort::none;
}

// Type functions access values in the byte order of the CPU; all other functions here use the byte order of the bus.
Abort begin_data(CO_SDO& channel, CO_OBJ& obj, uint8_t* data, uint32_t n) {
  const bool swaps = !wire::host_is_little_endian && !obj::is_stream(obj);
  if (swaps && has(channel.Flow, download)) {
    wire::swap_host(data, n);
  }
  CO_ERR err = obj::is_stream(obj) ? obj::seek(obj, *channel.Node, 0) : CO_ERR_NONE;
  if (err == CO_ERR_NONE) {
    err = call_read_or_write(channel, obj, data, n);
  }
  if (swaps && !has(channel.Flow, download)) {
    wire::swap_host(data, n);
  }
  return err == CO_ERR_NONE ? Abort::none : access::report_failure(*channel.Node, direction_of(channel), err);
}

Abort transfer_piece(CO_SDO& channel, uint32_t position, uint8_t* data, uint32_t n) {
  CO_ERR err = CO_ERR_NONE;
  if (has(channel.Flow, whole)) {
    CO_ASSERT(n <= sizeof channel.Value && position <= sizeof channel.Value - n);
    uint8_t* const value = channel.Value + position;
    has(channel.Flow, download) ? wire::copy(value, data, n) : wire::copy(data, value, n);
  } else if (n != 0) {
    if (channel.Obj == nullptr) {
      return Abort::device_state;
    }
    err = seek_piece(channel, *channel.Obj, position);
    if (has_block && err == CO_ERR_TYPE_AGAIN && state_of(channel) == State::block_upload) {
      set(channel.Flow, behind);
      return Abort::none;
    }
    if (may_end_itself && channel.Obj == nullptr) {
      return Abort::device_state;
    }
    if (err == CO_ERR_NONE) {
      err = call_read_or_write(channel, *channel.Obj, data, n);
    }
  }
  channel.Read = position + n;
  if (err != CO_ERR_NONE) {
    return access::report_failure(*channel.Node, direction_of(channel), err);
  }
  const bool may_end = obj::is_unknown(channel.Flow.Size) && !has(channel.Flow, download);
  return may_end ? learn_size(channel, position) : Abort::none;
}

}  // namespace co::sdo::server

// The access hook of SDO transfers.

#if USE_ACCESS_HOOK

namespace co::sdo::server {
namespace {

// Returns whether an initiate request is a block download; the command is one of the four initiate requests.
constexpr bool is_block_download(uint8_t command) { return command >= 0xC0; }
static_assert(wire::request_of(0xC0) == wire::Request::initiate_block_download);
static_assert(wire::request_of(0xA4) == wire::Request::initiate_block_upload);

void describe_download(CO_ACCESS_SDO& access, const CO_IF_FRM& request) {
  const uint8_t command = request.Data[0];
  const bool by_block = is_block_download(command);
  if (by_block ? wire::is_block_sized(command) : wire::is_size_indicated(command)) {
    access.Size = wire::get_high(request);
  }
  if (!by_block && wire::is_expedited(command)) {
    access.Size = wire::is_size_indicated(command) ? wire::expedited_length(command) : 0;
    access.Data = request.Data + 4;
  }
}

}  // namespace

Abort ask_application(CO_SDO& channel, const CO_IF_FRM& request) {
  CO_NODE& node = *channel.Node;
  CO_ACCESS_SDO access = {};
  access.Index = static_cast<uint16_t>(CO_GET_IDX(channel.Key));
  access.Sub = static_cast<uint8_t>(CO_GET_SUB(channel.Key));
  access.Channel = static_cast<uint8_t>(&channel - node.Sdo);
  if (has(channel.Flow, download)) {
    access.Direction = CO_OBJ_DOWNLOAD;
    describe_download(access, request);
  }
  return Abort{access_hook::ask<uint32_t, const CO_ACCESS_SDO>(node, &CO_CALLBACKS::AccessSdo, access)};
}

}  // namespace co::sdo::server

#endif
