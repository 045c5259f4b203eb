// SPDX-License-Identifier: Apache-2.0
#include "service/sdo/sdo_client.hpp"

#include "base/events.hpp"
#include "base/state_machine.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "service/sdo/client.hpp"
#include "wire/cob_id.hpp"

#if USE_CSDO

namespace co::sdo::client {
namespace {

void on_time(void* client_pointer) {
  CO_CSDO& client = *static_cast<CO_CSDO*>(client_pointer);
  if constexpr (has_block) {
    if (receives_block(client)) {
      handle_quarter(client);
      return;
    }
  }
  abort_transfer(client, Abort::time_out);
}

Abort refuse_response(Step&) { return Abort::command; }

// Returns whether the server does not support block transfer, which is optional for servers.
bool is_block_refused(const Step& step) {
  const Abort code{wire::get_high(step.response)};
  const uint32_t asked = in(State::block_download_initiated, State::block_upload_initiated);
  return (in(state_of(step.client)) & asked) != 0 && (code == Abort::command || code == Abort::general);
}

// Processes an abort of the server. If it refuses a block transfer, starts again without blocks.
Abort aborted(Step& step) {
  if (has_block && is_block_refused(step)) {
    put_initiate(step.client, false, step.request);
    return Abort::none;
  }
  complete(step);
  return wire::abort_code_in(step.response);
}

using Handler = Abort (*)(Step&);
using wire::Response;

constexpr uint32_t initiated = in(State::download_initiated, State::upload_initiated, State::block_download_initiated,
                                  State::block_upload_initiated);
constexpr uint32_t in_transfer =
    initiated | in(State::download, State::upload, State::block_download, State::block_download_end,
                   State::block_upload, State::block_upload_end);

constexpr Transition<Response, Handler> rows[] = {
    {in(State::download_initiated), Response::initiate_download, download_accepted},
    {in(State::download), Response::download_segment, segment_downloaded},

    {in(State::upload_initiated, State::block_upload_initiated), Response::initiate_upload, upload_accepted},
    {in(State::upload), Response::upload_segment, segment_uploaded},

    {in_transfer, Response::abort, aborted},

#if CO_CSDO_BLOCK > 0
    {in(State::block_download_initiated, State::block_download), Response::initiate_block_download,
     block_download_accepted},
    {in(State::block_download), Response::acknowledge_block, block_acknowledged},
    {in(State::block_download_end), Response::end_block_download, complete},

    {in(State::block_upload_initiated), Response::initiate_block_upload, block_upload_accepted},
    {in(State::block_upload, State::block_upload_end), Response::block_segment, block_segment_uploaded},
    {in(State::block_upload_end), Response::end_block_upload, block_upload_ended},
#endif
};

constexpr StateMachine<State, rows> state_machine(refuse_response);

// Returns whether the response to an initiate request names another object: it belongs to a previous transfer. Servers
// that do not support a request abort it with index 0, or with the object of their last transfer.
bool is_for_another(const CO_CSDO& client, const CO_IF_FRM& frame) {
  const uint32_t key = wire::multiplexer(frame);
  if ((in(state_of(client)) & initiated) == 0 || key == client.Key) {
    return false;
  }
  return frame.Data[0] != wire::abort_command || (key != 0 && Abort{wire::get_high(frame)} != Abort::command);
}

// Returns whether a server that waits for the end message of a block download repeats its acknowledge.
bool is_repeated(const CO_CSDO& client, const CO_IF_FRM& frame) {
  return has_block && state_of(client) == State::block_download_end && frame.Data[0] == wire::acknowledge_block;
}

// Returns the kind of a response. Segments of a block have no command specifier: the state decides.
Response response_in(const CO_CSDO& client, const CO_IF_FRM& frame) {
  const uint8_t command = frame.Data[0];
  if constexpr (has_block) {
    const State state = state_of(client);
    const bool in_block =
        state == State::block_upload || (state == State::block_upload_end && is_last_segment_again(client, frame));
    if (in_block && command != wire::abort_command) {
      return Response::block_segment;
    }
  }
  return wire::response_of(command);
}

CO_ERR send_initiate(CO_CSDO& client) {
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  put_initiate(client, true, request);
  if (!transmit::send(*client.Node, request)) {
    set_state(client, State::idle);
    return CO_ERR_IF_CAN_SEND;
  }
  start_timeout(client);
  client.State = CO_CSDO_STATE_BUSY;
  return CO_ERR_NONE;
}

// Converts the time-out to ticks. Time-outs beyond the timer's range are limited to the longest time.
uint32_t ticks(const CO_NODE& node, uint32_t timeout) {
  const uint32_t ticks = tmr::ticks(node, timeout, CO_TMR_UNIT_1MS);
  return timeout != 0 && ticks == 0 ? UINT32_MAX : ticks;
}

CO_ERR start(CO_CSDO& client, uint32_t timeout) {
  const CO_NODE& node = *client.Node;
  client.Ticks = ticks(node, timeout);
  if constexpr (has_own) {
    if (client.NodeId == node.NodeId) {
      queue_own_access(client);
      client.State = CO_CSDO_STATE_BUSY;
      return CO_ERR_NONE;
    }
  }
  return send_initiate(client);
}

CO_ERR check(CO_CSDO* client, const uint8_t* buf, bool is_empty, CO_CSDO_CALLBACK_T callback) {
  if (client == nullptr || client->Node == nullptr || buf == nullptr || callback == nullptr || is_empty) {
    return CO_ERR_BAD_ARG;
  }
  if (client->State == CO_CSDO_STATE_BUSY) {
    return CO_ERR_SDO_BUSY;
  }
  refresh(*client);
  const bool is_off = client->State == CO_CSDO_STATE_INVALID || !event::is_allowed(*client->Node, CO_SDO_ALLOWED);
  return is_off ? CO_ERR_SDO_OFF : CO_ERR_NONE;
}

CO_ERR request(CO_CSDO* client, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
               uint32_t timeout, uint8_t flags) {
  const CO_ERR err = check(client, buf, (size | flags) == 0, callback);
  if (err != CO_ERR_NONE) {
    return err;
  }
  client->Key = CO_GET_DEV(key);
  client->Buf = buf;
  client->Flow.Size = size;
  client->Call = callback;
  client->Flow.Flags = flags;
  return start(*client, timeout);
}

// An idle client ignores frames: responses to other clients with the same COB-IDs, and late responses. Not inlined:
// relative to a pointer to the client, all members are reached by short loads.
[[gnu::noinline]] void process_response(CO_CSDO& client, const CO_IF_FRM& response) {
  if (client.State != CO_CSDO_STATE_BUSY || is_for_another(client, response) || is_repeated(client, response)) {
    return;
  }
  const uint32_t num = client.Flow.Num;
  const uint8_t state = client.Flow.State;
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  Step step = {client, response, request, false};
  const Abort abort = state_machine(state_of(client), response_in(client, response))(step);
  if (abort != Abort::none && !step.done) {
    abort_transfer(client, abort);
    return;
  }
  if (request.DLC != 0) {
    transmit::send(*client.Node, request);
  }
  if (step.done) {
    finish(client, abort);
    return;
  }
  if constexpr (has_block) {
    send_segments(client);
  }
  if (client.Flow.Num != num || client.Flow.State != state) {  // frames without progress do not restart the time-out
    client.Flow.Idle = 1;
    start_timeout(client);
  }
}

}  // namespace

void start_timeout(CO_CSDO& client) {
  if (client.Ticks == 0) {
    return;
  }
  const uint32_t ticks = receives_block(client) ? (client.Ticks - 1) / quarters + 1 : client.Ticks;
  tmr::start(*client.Node, client.Tmr, ticks, 0, on_time, &client);
}

void finish(CO_CSDO& client, Abort code) {
  const uint32_t key = client.Key;
  tmr::stop(*client.Node, client.Tmr);
  set_state(client, State::idle);
  client.State = CO_CSDO_STATE_IDLE;
  client.Call(&client, CO_GET_IDX(key), CO_GET_SUB(key), static_cast<uint32_t>(code));
}

void abort_transfer(CO_CSDO& client, Abort code) {
  if (client.TxId != wire::no_frame && event::is_allowed(*client.Node, CO_SDO_ALLOWED)) {
    transmit::send(*client.Node, wire::abort_frame(client.TxId, client.Key, code));
  }
  finish(client, code);
}

// Protocol switch threshold: the server may send objects up to this size without blocks.
constexpr auto pst = static_cast<uint8_t>(CO_CSDO_BLOCK - 1);

void put_initiate(CO_CSDO& client, bool by_block, CO_IF_FRM& request) {
  const bool upload = !has(client.Flow, download);
  const bool block = has_block && by_block && client.Flow.Size > pst;
  const bool expedited = is_expedited(client);
  const uint32_t size = client.Flow.Size;
  client.Flow = {};
  client.Flow.Flags = upload ? 0 : download | sized;
  client.Flow.Size = size;
  if (upload) {
    set_state(client, block ? State::block_upload_initiated : State::upload_initiated);
    wire::put_head(request, block ? wire::accept_block : wire::initiate_upload_request, client.Key);
    request.Data[4] = block ? wire::max_blksize : 0;
    request.Data[5] = block ? pst : 0;
    return;
  }
  set_state(client, block ? State::block_download_initiated : State::download_initiated);
  const uint8_t segmented = block ? wire::initiate_block(true) : wire::initiate_download_request_sized;
  wire::put_head(request, expedited ? wire::expedited_download_request(client.Flow.Size) : segmented, client.Key);
  if (expedited) {
    __builtin_memcpy(request.Data + 4, client.Buf, client.Flow.Size);
  } else {
    wire::put_high(request, client.Flow.Size);
  }
}

void init(CO_NODE& node) {
  for (CO_CSDO& client : node.CSdo) {
    client = {};
    client.Node = &node;
    client.RxId = wire::no_frame;
    client.TxId = wire::no_frame;
    client.WasTxId = wire::no_frame;
  }
  configure(node);
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  if (frame.DLC != wire::sdo_dlc) {
    return false;
  }
  process_response(node.CSdo[number], frame);
  return true;
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_CSDO& client : node.CSdo) {
    transmit::withdraw(node, client.TxId);
    transmit::withdraw(node, client.WasTxId);
    if (client.State == CO_CSDO_STATE_BUSY) {
      finish(client, Abort::device_state);
    }
  }
}

bool on_free([[maybe_unused]] CO_NODE& node, [[maybe_unused]] uint16_t number) {
  if constexpr (has_block) {
    CO_CSDO& client = node.CSdo[number];
    if (send_segments(client)) {
      start_timeout(client);
      return true;
    }
  }
  return false;
}

}  // namespace co::sdo::client

extern "C" {

CO_CSDO* COCSdoFind(CO_NODE* node, uint8_t num) {
  if (node == nullptr || num >= CO_CSDO_N || node->CSdo[num].Node == nullptr) {
    return nullptr;
  }
  co::sdo::client::refresh(node->CSdo[num]);
  return node->CSdo[num].State == CO_CSDO_STATE_INVALID ? nullptr : &node->CSdo[num];
}

CO_ERR COCSdoRequestUpload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                           uint32_t timeout) {
  return co::sdo::client::request(csdo, key, buf, size, callback, timeout, 0);
}

CO_ERR COCSdoRequestDownload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                             uint32_t timeout) {
  return co::sdo::client::request(csdo, key, buf, size, callback, timeout, co::sdo::download | co::sdo::sized);
}

CO_ERR COCSdoCancel(CO_CSDO* csdo) {
  if (csdo == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (csdo->State != CO_CSDO_STATE_BUSY) {
    return CO_ERR_SDO_OFF;
  }
  if constexpr (co::sdo::client::has_own) {
    if (co::sdo::client::cancel_running_own_access(*csdo)) {
      return CO_ERR_NONE;
    }
  }
  co::sdo::client::abort_transfer(*csdo, co::Abort::local_control);
  return CO_ERR_NONE;
}

uint32_t COCSdoGetNum(const CO_CSDO* csdo) { return csdo == nullptr ? 0 : csdo->Flow.Num; }

uint32_t COCSdoGetTotal(const CO_CSDO* csdo) {
  return csdo == nullptr || !co::sdo::has(csdo->Flow, co::sdo::sized) ? 0 : csdo->Flow.Size;
}

}  // extern "C"

#endif
