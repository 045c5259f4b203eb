// SPDX-License-Identifier: Apache-2.0
// Access of an SDO client to the dictionary of the same node, with the rights of the network, without frames.
#include "base/events.hpp"
#include "base/timer.hpp"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/stream.hpp"
#include "service/sdo_client/transfer.hpp"

#if USE_CSDO && USE_CSDO_OWN

namespace co::sdo_client {
namespace {

// Returns whether the object is a number: it is converted between the byte order of the bus, which the buffer has, and
// that of the CPU, and is accessed in one call. Longer values and streams are opened first.
bool is_value(const CO_OBJ& obj, uint32_t size) { return !obj::is_stream(obj) && size <= sizeof(uint64_t); }

// Determines the final size of a stream of unknown size when the buffer is full: if the size is still unknown, reads
// one byte more. A stream that has further bytes does not fit.
CO_ERR find_end(CO_OBJ& obj, CO_NODE& node, uint32_t& size) {
  size = obj::size(obj, node, 0);
  if (!obj::is_unknown(size)) {
    return CO_ERR_NONE;
  }
  uint8_t more = 0;
  const CO_ERR err = obj::read(obj, node, &more, sizeof more);
  size = obj::size(obj, node, 0);
  return err;
}

Abort read_all(CO_CSDO& client, CO_OBJ& obj, uint32_t size) {
  CO_NODE& node = *client.Node;
  CO_ERR err = is_value(obj, size) ? CO_ERR_NONE : COObjRdBufStart(&obj, &node, client.Buf, 0);
  if (err == CO_ERR_NONE && size != 0) {
    err = obj::read(obj, node, client.Buf, obj::is_unknown(size) ? client.Size : size);
  }
  if (err == CO_ERR_NONE && obj::is_unknown(size)) {
    err = find_end(obj, node, size);
  }
  if (err != CO_ERR_NONE) {
    return access::report_failure(node, CO_OBJ_UPLOAD, err);
  }
  if (size > client.Size) {
    return Abort::memory;
  }
  if (is_value(obj, size)) {
    wire::swap_host(client.Buf, size);
  }
  client.Total = size;
  client.Num = size;
  return Abort::none;
}

Abort write_all(CO_CSDO& client, CO_OBJ& obj) {
  CO_NODE& node = *client.Node;
  uint8_t value[sizeof(uint64_t)];
  uint8_t* from = client.Buf;
  CO_ERR err = CO_ERR_NONE;
  if (is_value(obj, client.Size)) {
    __builtin_memcpy(value, client.Buf, client.Size);
    wire::swap_host(value, client.Size);
    from = value;
  } else {
    err = obj::seek(obj, node, 0);
    if (err == CO_ERR_NONE) {
      err = obj::write(obj, node, client.Buf, 0);
    }
  }
  if (err == CO_ERR_NONE && client.Size != 0) {
    err = obj::write(obj, node, from, client.Size);
  }
  client.Num = client.Size;
  return err == CO_ERR_NONE ? Abort::none : access::report_failure(node, CO_OBJ_DOWNLOAD, err);
}

Abort check_upload(CO_CSDO& client, CO_OBJ& obj, uint32_t size) {
  if (obj::is_no_size(obj, size)) {
    return access::abort_for(*client.Node, CO_ERR_TYPE_RD);
  }
  return !obj::is_unknown(size) && size > client.Size ? Abort::memory : Abort::none;
}

// Checks the length before the type's Begin function is called.
Abort check_size(CO_CSDO& client, CO_OBJ& obj, uint32_t& size) {
  if (has(client, is_upload)) {
    size = obj::size(obj, *client.Node, 0);
    return check_upload(client, obj, size);
  }
  size = client.Size;
  return access::check_length(*client.Node, obj, size);
}

Abort transfer(CO_CSDO& client, CO_OBJ& obj, CO_OBJ_TRANSFER direction) {
  CO_NODE& node = *client.Node;
  uint32_t size = 0;
  Abort abort = check_size(client, obj, size);
  if (abort != Abort::none) {
    return abort;
  }
  CO_ERR err = obj::begin(obj, node, direction, size);
  if (err != CO_ERR_NONE) {
    return access::abort_for(node, err);
  }
  abort = direction == CO_OBJ_UPLOAD ? read_all(client, obj, size) : write_all(client, obj);
  err = obj::end(obj, node, direction, abort);
  const bool refused = abort == Abort::none && err != CO_ERR_NONE && direction == CO_OBJ_DOWNLOAD;
  return refused ? access::report_failure(node, CO_OBJ_DOWNLOAD, err) : abort;
}

// Reads or writes the object. Returns an abort code.
Abort access_own(CO_CSDO& client) {
  CO_NODE& node = *client.Node;
  const CO_OBJ_TRANSFER direction = has(client, is_upload) ? CO_OBJ_UPLOAD : CO_OBJ_DOWNLOAD;
  const access::Request request(node, nullptr);
  CO_OBJ* const obj = dict::find(node, client.Key);
  const Abort abort = stream::check(node, client.Key, obj, direction);
  if (abort != Abort::none) {
    return abort;
  }
  node.Request->Obj = obj;
  const bool taken = obj::is_stream(*obj) && access::is_open(node, *obj, nullptr);
  return taken ? Abort::device_state : transfer(client, *obj, direction);
}

void run_own_access(void* client_pointer) {
  CO_CSDO& client = *static_cast<CO_CSDO*>(client_pointer);
  set_state(client, State::own_running);
  const Abort code = access_own(client);
  finish(client, state_of(client) == State::own_running ? code : Abort::local_control);
}

}  // namespace

void queue_own_access(CO_CSDO& client) {
  client.Num = 0;
  client.Total = has(client, is_upload) ? 0 : client.Size;
  set_state(client, State::own);
  tmr::start(*client.Node, client.Tmr, 1, 0, run_own_access, &client);
}

bool cancel_running_own_access(CO_CSDO& client) {
  const bool is_running = state_of(client) == State::own_running || state_of(client) == State::own_cancelled;
  if (is_running) {
    set_state(client, State::own_cancelled);
  }
  return is_running;
}

}  // namespace co::sdo_client

#endif
