// SPDX-License-Identifier: Apache-2.0
// Access of an SDO client to the dictionary of the same node, with the rights of the network, without frames.
#include "base/events.hpp"
#include "base/timer.hpp"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/stream.hpp"
#include "service/sdo/client.hpp"
#include "service/sdo/server.hpp"

#if USE_CSDO && USE_CSDO_OWN

namespace co::sdo::client {
namespace {

using server::begin_data;
using server::transfer_piece;

// Checks the length of an object to be read or written, and sets Size. Returns an abort code.
Abort check_size(const CO_CSDO& client, CO_SDO& channel, CO_OBJ& obj) {
  CO_NODE& node = *client.Node;
  channel.Flow.Size = client.Flow.Size;
  if (has(client.Flow, download)) {
    return access::check_length(node, obj, client.Flow.Size);
  }
  channel.Flow.Size = access::size(obj, node, 0);
  if (obj::is_no_size(obj, channel.Flow.Size)) {
    return access::abort_for(node, CO_ERR_TYPE_RD);
  }
  return !obj::is_unknown(channel.Flow.Size) && channel.Flow.Size > client.Flow.Size ? Abort::memory : Abort::none;
}

// Reads or writes an object in pieces: all bytes, and for an object of unknown size that fills the buffer one more,
// which must not exist.
Abort transfer_pieces(const CO_CSDO& client, CO_SDO& channel, CO_OBJ& obj) {
  const Abort abort = begin_data(channel, obj, channel.Value, 0);
  if (abort != Abort::none || channel.Flow.Size == 0) {
    return abort;
  }
  const bool is_unknown = obj::is_unknown(channel.Flow.Size);
  const Abort read = transfer_piece(channel, 0, client.Buf, is_unknown ? client.Flow.Size : channel.Flow.Size);
  if (read != Abort::none || !is_unknown || !obj::is_unknown(channel.Flow.Size)) {
    return read;
  }
  return transfer_piece(channel, client.Flow.Size, channel.Value, 1);
}

// Reads or writes a number, which the buffer has in the byte order of the bus.
Abort transfer_value(const CO_CSDO& client, CO_SDO& channel, CO_OBJ& obj) {
  uint8_t* data = client.Buf;
  if (has(client.Flow, download)) {
    data = channel.Value;
    wire::copy(data, client.Buf, channel.Flow.Size);
  }
  return begin_data(channel, obj, data, channel.Flow.Size);
}

Abort transfer(CO_CSDO& client, CO_SDO& channel, CO_OBJ& obj) {
  Abort abort = check_size(client, channel, obj);
  if (abort == Abort::none && obj::is_stream(obj)) {
    abort = server::begin_stream(channel, obj, channel.Flow.Size);
  }
  if (abort != Abort::none) {
    return abort;
  }
  channel.Obj = &obj;
  abort = server::is_value(channel, obj) ? transfer_value(client, channel, obj) : transfer_pieces(client, channel, obj);
  if (abort == Abort::none && channel.Flow.Size > client.Flow.Size) {
    abort = Abort::memory;
  }
  if (abort == Abort::none) {
    client.Flow.Size = channel.Flow.Size;
    set(client.Flow, sized);
    client.Flow.Num = channel.Flow.Size;
  }
  const Abort refused = server::close(channel, abort);
  return abort != Abort::none ? abort : refused;
}

// Reads or writes the object by the functions of an SDO server. Returns an abort code.
Abort access_own(CO_CSDO& client) {
  CO_NODE& node = *client.Node;
  CO_SDO channel = {};
  channel.Node = &node;
  channel.Flow.Flags = client.Flow.Flags & download;
  const access::Request request(node, nullptr);
  CO_OBJ* const obj = dict::find(node, client.Key);
  const Abort abort = stream::check(node, client.Key, obj, access::direction_of(channel));
  if (abort != Abort::none) {
    return abort;
  }
  node.Request->Obj = obj;
  return transfer(client, channel, *obj);
}

void run_own_access(void* client_pointer) {
  CO_CSDO& client = *static_cast<CO_CSDO*>(client_pointer);
  set_state(client, State::own_running);
  const Abort code = access_own(client);
  finish(client, state_of(client) == State::own_running ? code : Abort::local_control);
}

}  // namespace

void queue_own_access(CO_CSDO& client) {
  client.Flow.Num = 0;
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

}  // namespace co::sdo::client

#endif
