// SPDX-License-Identifier: Apache-2.0
#include "service/sdo_server/sdo_server.hpp"

#include "core/dict.hpp"
#include "core/events.hpp"
#include "core/machine.hpp"
#include "core/routes.hpp"
#include "core/timer.hpp"
#include "core/transmit.hpp"
#include "service/sdo_server/transfer.hpp"
#include "wire/cob_id.hpp"

namespace co::sdo_server {
namespace {

uint32_t end_by_client(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  close(channel, wire::abort_code_in(request));
  silence(answer);
  return no_abort;
}

// The abort names the transfer that it ends; without one, or where the request wants another, what the request names.
uint32_t refuse_initiate(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM&) {
  restart(channel, request);
  return CO_SDO_ERR_CMD;
}

uint32_t refuse_command(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer) {
  return state_of(channel) == State::idle ? refuse_initiate(channel, request, answer) : CO_SDO_ERR_CMD;
}

using wire::Request;

// A new initiate in an open transfer drops that and is served: its client has started anew. [301:7.2.4.3] Within a
// block of a download everything but an abort is a segment.
constexpr uint32_t outside_block = in(State::idle, State::download, State::upload, State::block_download_end,
                                      State::block_upload_ready, State::block_upload, State::block_upload_end);

constexpr Row<Request, Service> rows[] = {
    {outside_block | in(State::block_download), Request::abort, end_by_client},

    {outside_block, Request::initiate_download, initiate_download},
    {in(State::download), Request::download_segment, download_segment},

    {outside_block, Request::initiate_upload, initiate_upload},
    {in(State::upload), Request::upload_segment, upload_segment},

#if USE_SDO_BLOCK
    {outside_block, Request::initiate_block_download, initiate_block_download},
    {in(State::block_download, State::block_download_end), Request::block_segment, download_block_segment},
    {in(State::block_download_end), Request::end_block_download, end_block_download},

    {outside_block, Request::initiate_block_upload, initiate_block_upload},
    {in(State::block_upload_ready), Request::start_block_upload, start_block_upload},
    {in(State::block_upload), Request::acknowledge_block, acknowledge_block},
    {in(State::block_upload_end), Request::end_block_upload, end_block_upload},
#else
    {outside_block, Request::initiate_block_download, refuse_initiate},
    {outside_block, Request::initiate_block_upload, refuse_initiate},
#endif
};

constexpr auto machine =
    make_machine<State, static_cast<size_t>(State::count), wire::command_count>(rows, refuse_command);

// Segments of a block look like anything; the state tells them.
bool is_segment(const CO_SDO& channel, const CO_IF_FRM& frame) {
  const State state = state_of(channel);
  return has_block && (state == State::block_download || state == State::block_download_end) &&
         frame.Data[0] != wire::abort_command &&
         (state == State::block_download || is_last_segment_again(channel, frame));
}

// The transfer is over, without an abort where SDO is no longer allowed.
void give_up(CO_SDO& channel, uint32_t abort) {
  CO_NODE& node = *channel.Node;
  if (!event::is_allowed(node, CO_SDO_ALLOWED)) {
    on_mode(node);
    return;
  }
  send_abort(channel, abort);
  close(channel, abort);
}

// A channel is busy while its type functions run: they may change the NMT state. Not inlined: a channel by itself lies
// within reach of short loads.
[[gnu::noinline]] bool serve(CO_SDO& channel, const CO_IF_FRM& frame) {
  if (frame.DLC != wire::sdo_dlc) {
    return false;
  }
  CO_NODE& node = *channel.Node;
  CO_IF_FRM answer = wire::empty_frame(channel.TxId);
  const Request request = is_segment(channel, frame) ? Request::block_segment : wire::request_of(frame.Data[0]);
  channel.Idle = busy;
  access::serve(node, channel.Obj);
  const uint32_t abort = machine(state_of(channel), request)(channel, frame, answer);
  channel.Idle = 0;
  node.Served = nullptr;
  if (abort != no_abort || !event::is_allowed(node, CO_SDO_ALLOWED)) {
    give_up(channel, abort);
  } else if (answer.DLC != 0) {
    transmit::send(node, answer);
  }
  return true;
}

#if USE_SDO_BLOCK
bool send_next(CO_SDO& channel) {
  CO_NODE& node = *channel.Node;
  const uint8_t idle = channel.Idle;
  uint32_t abort = no_abort;
  channel.Idle = busy;
  access::serve(node, channel.Obj);
  const bool sent = send_segment(channel, abort);
  channel.Idle = sent ? 0 : idle;
  node.Served = nullptr;
  if (abort == no_abort && event::is_allowed(node, CO_SDO_ALLOWED)) {
    return sent;
  }
  give_up(channel, abort);
  return false;
}
#endif

// Without an entry the default server has the COB-IDs that every node reserves for it. [301:7.3.5]
uint32_t cob_id(CO_NODE& node, uint16_t number, uint8_t sub, wire::CobId base) {
  return dict::read_cob_id(node.Dict, CO_DEV(0x1200U + number, sub),
                           number == 0 ? base + node.NodeId : wire::cob_invalid);
}

void configure_channel(CO_NODE& node, uint16_t number) {
  CO_SDO& channel = node.Sdo[number];
  const uint32_t rx = cob_id(node, number, 1, wire::CobId::sdo_rx);
  const uint32_t tx = cob_id(node, number, 2, wire::CobId::sdo_tx);
  const bool valid = rx != wire::cob_invalid && tx != wire::cob_invalid;
  const uint32_t rx_id = valid ? wire::frame_id(rx) : wire::no_frame;
  const uint32_t tx_id = valid ? wire::frame_id(tx) : wire::no_frame;
  if (channel.RxId == rx_id && channel.TxId == tx_id) {
    return;
  }
  close(channel, CO_SDO_ERR_TOS_STATE);
  channel.RxId = rx_id;
  if (channel.TxId != tx_id) {  // an answer that waits keeps the old one
    transmit::withdraw(node, channel.WasTxId);
    channel.WasTxId = channel.TxId;
    channel.TxId = tx_id;
  }
  routes::change(node, rx_id, routes::Service::sdo_server, number);
}

}  // namespace

void init(CO_NODE& node) {
  for (CO_SDO& channel : node.Sdo) {
    channel = {};
    channel.Node = &node;
    channel.RxId = wire::no_frame;
    channel.TxId = wire::no_frame;
    channel.WasTxId = wire::no_frame;
  }
  tmr::stop(node.Tmr, node.SdoTmr);
  configure(node);
}

void configure(CO_NODE& node) {
  for (uint16_t number = 0; number < CO_SSDO_N; ++number) {
    configure_channel(node, number);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) { return serve(node.Sdo[number], frame); }

bool on_free([[maybe_unused]] CO_NODE& node, [[maybe_unused]] uint16_t number) {
#if USE_SDO_BLOCK
  CO_SDO& channel = node.Sdo[number];
  if (state_of(channel) == State::block_upload) {
    return send_next(channel);
  }
#endif
  return false;
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_SDO& channel : node.Sdo) {
    if (channel.Idle != busy) {
      close(channel, CO_SDO_ERR_TOS_STATE);
    }
    transmit::withdraw(node, channel.TxId);
    transmit::withdraw(node, channel.WasTxId);
  }
  rest(node);
}

}  // namespace co::sdo_server
