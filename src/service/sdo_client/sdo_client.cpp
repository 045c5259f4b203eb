// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_client/sdo_client.hpp"

#include "core/dict.hpp"
#include "core/events.hpp"
#include "core/machine.hpp"
#include "core/routes.hpp"
#include "core/timer.hpp"
#include "core/transmit.hpp"
#include "service/sdo_client/transfer.hpp"
#include "wire/cob_id.hpp"

#if USE_CSDO

namespace co::sdo_client {
namespace {

// A quarter of the time-out is what the client listens at a time in a block upload.
constexpr uint32_t quarters = 4;
constexpr uint8_t reminder_quarter = 2;

void on_time(void* client_pointer);

bool listens(const CO_CSDO& client) {
  return state_of(client) == State::block_upload || state_of(client) == State::block_upload_end;
}

void await(CO_CSDO& client) {
  if (client.Ticks == 0) {
    return;
  }
  const uint32_t ticks = listens(client) ? (client.Ticks - 1) / quarters + 1 : client.Ticks;
  clear(client, active);
  tmr::start(client.Node->Tmr, client.Tmr, ticks, 0, on_time, &client);
}

// Must be last: the callback may start the next transfer.
void finish(CO_CSDO& client, uint32_t code) {
  if (state_of(client) == State::own_served) {
    set_state(client, State::own_ended);
    client.Ticks = code;
  }
  if (state_of(client) == State::own_ended) {
    return;
  }
  const uint32_t key = client.Key;
  tmr::stop(client.Node->Tmr, client.Tmr);
  set_state(client, State::idle);
  client.State = CO_CSDO_STATE_IDLE;
  client.Call(&client, CO_GET_IDX(key), CO_GET_SUB(key), code);
}

void abort_transfer(CO_CSDO& client, uint32_t code) {
  if (client.TxId != wire::no_frame && event::is_allowed(*client.Node, CO_SDO_ALLOWED)) {
    transmit::send(*client.Node, wire::abort_frame(client.TxId, client.Key, code));
  }
  finish(client, code);
}

// A server that has stopped in the middle of a block may have lost the acknowledge, or the client its last segment.
void listen_on(CO_CSDO& client) {
  client.Silence = has(client, active) ? 0 : static_cast<uint8_t>(client.Silence + 1);
  if (client.Silence == quarters) {
    abort_transfer(client, CO_SDO_ERR_TIMEOUT);
    return;
  }
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  if (client.Silence == reminder_quarter && put_reminder(client, request)) {
    transmit::send(*client.Node, request);
  }
  await(client);
}

// What type functions ask for waits until the access is over; a change of the NMT state has ended it already.
void take_turn(CO_CSDO& client) {
  CO_NODE& node = *client.Node;
  const uint8_t busy = node.Busy;
  node.Busy = 1;
  set_state(client, State::own_served);
  const uint32_t code = access_own(client);
  const bool is_over = state_of(client) == State::own_ended;
  set_state(client, State::own);
  finish(client, is_over ? client.Ticks : code);
  node.Busy = busy;
  event::settle(node);
}

void on_time(void* client_pointer) {
  CO_CSDO& client = *static_cast<CO_CSDO*>(client_pointer);
  if (state_of(client) == State::own) {
    take_turn(client);
  } else if (listens(client)) {
    listen_on(client);
  } else {
    abort_transfer(client, CO_SDO_ERR_TIMEOUT);
  }
}

uint32_t refuse_response(Step&) { return CO_SDO_ERR_CMD; }

uint32_t aborted(Step& step) {
  step.silent = true;
  step.done = true;
  step.result = wire::abort_code_in(step.response);
  return no_abort;
}

// Block transfer is optional for servers; the others are not.
uint32_t block_refused(Step& step) {
  const uint32_t code = wire::get_high(step.response);
  if (code != CO_SDO_ERR_CMD && code != CO_SDO_ERR_GENERAL) {
    return aborted(step);
  }
  put_initiate(step.client, false, step.request);
  return no_abort;
}

using Service = uint32_t (*)(Step&);
using wire::Response;

constexpr uint32_t initiated = in(State::download_initiated, State::upload_initiated, State::block_download_initiated,
                                  State::block_upload_initiated);

constexpr Row<Response, Service> rows[] = {
    {in(State::download_initiated), Response::initiate_download, download_accepted},
    {in(State::download), Response::download_segment, segment_downloaded},

    {in(State::upload_initiated, State::block_upload_initiated), Response::initiate_upload, upload_accepted},
    {in(State::upload), Response::upload_segment, segment_uploaded},

    {in(State::download_initiated, State::download, State::upload_initiated, State::upload), Response::abort, aborted},

#if USE_SDO_BLOCK
    {in(State::block_download_initiated), Response::initiate_block_download, block_download_accepted},
    {in(State::block_download), Response::acknowledge_block, block_acknowledged},
    {in(State::block_download_end), Response::end_block_download, block_download_confirmed},

    {in(State::block_upload_initiated), Response::initiate_block_upload, block_upload_accepted},
    {in(State::block_upload, State::block_upload_end), Response::block_segment, block_segment_uploaded},
    {in(State::block_upload_end), Response::end_block_upload, block_upload_ended},

    {in(State::block_download_initiated, State::block_upload_initiated), Response::abort, block_refused},
    {in(State::block_download, State::block_download_end, State::block_upload, State::block_upload_end),
     Response::abort, aborted},
#endif
};

constexpr auto machine =
    make_machine<State, static_cast<size_t>(State::count), wire::command_count>(rows, refuse_response);

// An answer that names another object belongs to an older transfer.
bool is_for_another(const CO_CSDO& client, const CO_IF_FRM& frame) {
  return (in(state_of(client)) & initiated) != 0 && wire::multiplexer(frame) != client.Key;
}

// Segments of a block look like anything; the state tells them.
Response response_in(const CO_CSDO& client, const CO_IF_FRM& frame) {
  const bool in_block =
      USE_SDO_BLOCK != 0 && (state_of(client) == State::block_upload ||
                             (state_of(client) == State::block_upload_end && is_last_segment_again(client, frame)));
  const uint8_t command = frame.Data[0];
  return in_block && command != wire::abort_command ? Response::block_segment : wire::response_of(command);
}

bool is_usable(uint32_t cob_id) {
  return (cob_id & wire::cob_invalid) == 0 && wire::fits_format(cob_id) && (cob_id & wire::extended_ids) != 0;
}

uint32_t cob_id(CO_NODE& node, uint16_t number, uint8_t sub) {
  uint32_t value = 0;
  const CO_ERR err = dict::read_u32(node.Dict, CO_DEV(0x1280U + number, sub), value);
  return err == CO_ERR_NONE && is_usable(value) ? value : wire::cob_invalid;
}

struct Configuration {
  uint32_t tx_id;
  uint32_t rx_id;
  uint8_t node_id;
  CO_CSDO_STATE state;  // idle: there is a server
};

bool are_bases(uint32_t tx, uint32_t rx) {
  return tx == wire::CobId::sdo_rx + uint8_t{0} && rx == wire::CobId::sdo_tx + uint8_t{0};
}

// The own dictionary needs no identifiers.
Configuration read_configuration(CO_NODE& node, uint16_t number) {
  constexpr uint8_t last_node_id = 127;
  Configuration found = {wire::no_frame, wire::no_frame, 0, CO_CSDO_STATE_INVALID};
  const uint32_t tx = cob_id(node, number, 1);
  const uint32_t rx = cob_id(node, number, 2);
  if (CODictRdByte(&node.Dict, CO_DEV(0x1280U + number, 3), &found.node_id) != CO_ERR_NONE) {
    found.node_id = 0;
  }
  const uint8_t relative = are_bases(tx, rx) ? found.node_id : 0;
  const bool has_id = relative != 0 || !are_bases(tx, rx);
  if (tx == wire::cob_invalid || rx == wire::cob_invalid || !has_id || relative > last_node_id) {
    return found;
  }
  found.state = CO_CSDO_STATE_IDLE;
  if (found.node_id != node.NodeId) {
    found.tx_id = wire::frame_id(tx + relative);
    found.rx_id = wire::frame_id(rx + relative);
  }
  return found;
}

bool is_configured(const CO_CSDO& client, const Configuration& as) {
  const bool is_off = client.State == CO_CSDO_STATE_INVALID;
  return client.TxId == as.tx_id && client.RxId == as.rx_id && client.NodeId == as.node_id &&
         is_off == (as.state == CO_CSDO_STATE_INVALID);
}

uint16_t number_of(const CO_CSDO& client) { return static_cast<uint16_t>(&client - client.Node->CSdo); }

void take_configuration(CO_CSDO& client, const Configuration& found) {
  CO_NODE& node = *client.Node;
  client.TxId = found.tx_id;
  client.RxId = found.rx_id;
  client.NodeId = found.node_id;
  client.State = found.state;
  routes::remove(node, service, number_of(client));
  if (found.rx_id != wire::no_frame) {
    routes::add(node, found.rx_id, service, number_of(client));
  }
}

// True: something has changed. The callback of a transfer that ends may have configured the client already.
bool configure_client(CO_CSDO& client) {
  if (is_configured(client, read_configuration(*client.Node, number_of(client)))) {
    return false;
  }
  if (client.State == CO_CSDO_STATE_BUSY) {
    abort_transfer(client, CO_SDO_ERR_TOS_STATE);
  }
  if (client.State == CO_CSDO_STATE_BUSY) {
    return false;
  }
  take_configuration(client, read_configuration(*client.Node, number_of(client)));
  return true;
}

void refresh(CO_CSDO& client) {
  if (client.State != CO_CSDO_STATE_BUSY && configure_client(client)) {
    routes::publish(*client.Node);
  }
}

CO_ERR send_initiate(CO_CSDO& client) {
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  put_initiate(client, true, request);
  if (!transmit::send(*client.Node, request)) {
    set_state(client, State::idle);
    return CO_ERR_IF_CAN_SEND;
  }
  await(client);
  return CO_ERR_NONE;
}

// A timer does it, so that the callback never comes before the request has returned.
void queue_own(CO_CSDO& client) {
  client.Num = 0;
  client.Total = has(client, is_upload) ? 0 : client.Size;
  set_state(client, State::own);
  tmr::start(client.Node->Tmr, client.Tmr, 1, 0, on_time, &client);
}

// What the timer cannot count is longer than anybody waits.
uint32_t ticks(const CO_NODE& node, uint32_t timeout) {
  const uint32_t ticks = tmr::ticks(node.Tmr, timeout, CO_TMR_UNIT_1MS);
  return timeout != 0 && ticks == 0 ? UINT32_MAX : ticks;
}

CO_ERR start(CO_CSDO& client, uint32_t timeout) {
  const CO_NODE& node = *client.Node;
  client.Ticks = ticks(node, timeout);
  if (client.NodeId == node.NodeId) {
    queue_own(client);
  } else if (const CO_ERR err = send_initiate(client); err != CO_ERR_NONE) {
    return err;
  }
  client.State = CO_CSDO_STATE_BUSY;
  return CO_ERR_NONE;
}

CO_ERR check(CO_CSDO* client, const uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback) {
  if (client == nullptr || client->Node == nullptr || buf == nullptr || callback == nullptr || size == 0) {
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
  const CO_ERR err = check(client, buf, size, callback);
  if (err != CO_ERR_NONE) {
    return err;
  }
  client->Key = CO_GET_DEV(key);
  client->Buf = buf;
  client->Size = size;
  client->Call = callback;
  client->Flags = flags;
  return start(*client, timeout);
}

void send_segments(CO_CSDO& client) {
  while (send_segment(client)) {
  }
  await(client);
}

// Not inlined: a client by itself lies within reach of short loads.
[[gnu::noinline]] void take(CO_CSDO& client, const CO_IF_FRM& response) {
  CO_IF_FRM request = wire::empty_frame(client.TxId);
  Step step = {client, response, request, false, false, no_abort};
  const uint32_t abort = machine(state_of(client), response_in(client, response))(step);
  if (abort != no_abort) {
    abort_transfer(client, abort);
    return;
  }
  if (!step.silent) {
    transmit::send(*client.Node, request);
  }
  if (step.done) {
    finish(client, step.result);
  } else if (state_of(client) == State::block_download) {
    send_segments(client);
  } else if (!step.silent) {
    client.Silence = 0;
    await(client);
  }
}

}  // namespace

void put_initiate(CO_CSDO& client, bool by_block, CO_IF_FRM& request) {
  const bool upload = has(client, is_upload);
  const bool block = USE_SDO_BLOCK != 0 && by_block && client.Size >= CO_CSDO_BLOCK;
  const bool expedited = client.Size <= wire::expedited_bytes;
  client.Flags = upload ? is_upload : 0;
  client.Num = 0;
  client.Total = upload ? 0 : client.Size;
  client.Toggle = 0;
  client.Crc = 0;
  client.AckSeq = 0;
  client.Silence = 0;
  if (upload) {
    set_state(client, block ? State::block_upload_initiated : State::upload_initiated);
    wire::put_head(request, block ? wire::accept_block : wire::initiate_upload_request, client.Key);
    request.Data[4] = block ? wire::max_blksize : 0;
    request.Data[5] = block ? CO_CSDO_BLOCK - 1 : 0;
    return;
  }
  set_state(client, block ? State::block_download_initiated : State::download_initiated);
  const uint8_t segmented = block ? wire::initiate_block(true) : wire::initiate_download_request_sized;
  wire::put_head(request, expedited ? wire::expedited_download_request(client.Size) : segmented, client.Key);
  if (expedited) {
    __builtin_memcpy(request.Data + 4, client.Buf, client.Size);
  } else {
    wire::put_high(request, client.Size);
  }
}

void init(CO_NODE& node) {
  for (CO_CSDO& client : node.CSdo) {
    client = {};
    client.Node = &node;
    client.RxId = wire::no_frame;
    client.TxId = wire::no_frame;
  }
  configure(node);
}

void configure(CO_NODE& node) {
  for (CO_CSDO& client : node.CSdo) {
    configure_client(client);
  }
}

// An idle client hears what others, on the same COB-IDs, are answered, and what comes late.
bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  const bool well_formed = frame.DLC == wire::sdo_dlc;
  CO_CSDO& client = node.CSdo[number];
  if (well_formed && client.State == CO_CSDO_STATE_BUSY && !is_for_another(client, frame)) {
    take(client, frame);
  }
  return well_formed;
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_CSDO& client : node.CSdo) {
    transmit::withdraw(node, client.TxId);
    if (client.State == CO_CSDO_STATE_BUSY) {
      finish(client, CO_SDO_ERR_TOS_STATE);
    }
  }
}

bool on_free(CO_NODE& node, uint16_t number) {
  CO_CSDO& client = node.CSdo[number];
  const bool sent = USE_SDO_BLOCK != 0 && send_segment(client);
  if (sent) {
    await(client);
  }
  return sent;
}

}  // namespace co::sdo_client

using namespace co;

extern "C" {

CO_CSDO* COCSdoFind(CO_NODE* node, uint8_t num) {
  if (node == nullptr || num >= CO_CSDO_N || node->CSdo[num].Node == nullptr) {
    return nullptr;
  }
  sdo_client::refresh(node->CSdo[num]);
  return node->CSdo[num].State == CO_CSDO_STATE_INVALID ? nullptr : &node->CSdo[num];
}

CO_ERR COCSdoRequestUpload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                           uint32_t timeout) {
  return sdo_client::request(csdo, key, buf, size, callback, timeout, sdo_client::is_upload);
}

CO_ERR COCSdoRequestDownload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                             uint32_t timeout) {
  return sdo_client::request(csdo, key, buf, size, callback, timeout, 0);
}

CO_ERR COCSdoCancel(CO_CSDO* csdo) {
  if (csdo == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (csdo->State != CO_CSDO_STATE_BUSY) {
    return CO_ERR_SDO_OFF;
  }
  sdo_client::abort_transfer(*csdo, CO_SDO_ERR_TOS_LOCAL);
  return CO_ERR_NONE;
}

uint32_t COCSdoGetNum(const CO_CSDO* csdo) { return csdo == nullptr ? 0 : csdo->Num; }

uint32_t COCSdoGetTotal(const CO_CSDO* csdo) { return csdo == nullptr ? 0 : csdo->Total; }

}  // extern "C"

#endif
