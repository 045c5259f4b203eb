// SPDX-License-Identifier: Apache-2.0
#include "service/sdo/sdo_server.hpp"

#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/state_machine.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "service/sdo/fast_paths.hpp"
#include "service/sdo/server.hpp"
#include "wire/cob_id.hpp"

namespace co::sdo::server {
namespace {

Abort end_by_client(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM& answer, CO_OBJ*) {
  close(channel, wire::abort_code_in(request));
  silence(answer);
  return Abort::none;
}

using wire::Request;

// Aborts with the key of the open transfer; if there is none, or if the request initiates one, with the key in the
// request.
Abort refuse_command(CO_SDO& channel, const CO_IF_FRM& request, CO_IF_FRM&, CO_OBJ*) {
  const Request command = wire::request_of(request.Data[0]);
  const bool begins = command == Request::initiate_block_download || command == Request::initiate_block_upload;
  if (begins || state_of(channel) == State::idle) {
    restart(channel, request);
  }
  return Abort::command;
}

// States in which an initiate request closes an open transfer and starts a new one. [301:7.2.4.3] Within a block of a
// download every frame but an abort is a segment.
constexpr uint32_t outside_block = in(State::idle, State::download, State::upload, State::block_download_end,
                                      State::block_upload_ready, State::block_upload, State::block_upload_end);

constexpr Transition<Request, Handler> rows[] = {
    {outside_block | in(State::block_download), Request::abort, end_by_client},

    {outside_block, Request::initiate_download, initiate},
    {in(State::download), Request::download_segment, download_segment},

    {outside_block, Request::initiate_upload, initiate},
    {in(State::upload), Request::upload_segment, upload_segment},

#if USE_SDO_BLOCK
    {outside_block, Request::initiate_block_download, initiate},
    {in(State::block_download, State::block_download_end), Request::block_segment, end_block},
    {in(State::block_download_end), Request::end_block_download, end_block_download},

    {outside_block, Request::initiate_block_upload, initiate},
    {in(State::block_upload_ready), Request::start_block_upload, start_block_upload},
    {in(State::block_upload), Request::acknowledge_block, acknowledge_block},
    {in(State::block_upload_end), Request::end_block_upload, end_block_upload},
#endif
};

constexpr StateMachine<State, rows> state_machine(refuse_command);

// Returns whether a frame is a segment of a block download. Segments have no command specifier: the state decides.
bool is_segment(const CO_SDO& channel, const CO_IF_FRM& frame) {
  const State state = state_of(channel);
  return has_block && (state == State::block_download || state == State::block_download_end) &&
         frame.Data[0] != wire::abort_command &&
         (state == State::block_download || is_last_segment_again(channel.Flow, buffer_of(channel), frame));
}

// Runs a handler, and sends its answer or aborts the transfer.
inline void run_handler(CO_SDO& channel, Handler handler, const CO_IF_FRM& request, CO_OBJ* found) {
  CO_NODE& node = *channel.Node;
  CO_ASSERT(state_of(channel) < State::count);
  CO_IF_FRM answer = wire::empty_frame(channel.TxId);
  CO_REQUEST own = {channel.Obj, 0};
  node.Request = &own;
  const Abort abort = handler(channel, request, answer, found);
  node.Request = nullptr;
  if (abort != Abort::none) {
    abort_transfer(channel, abort);
  } else if (answer.DLC != 0) {
    transmit::send(node, answer);
  }
}

// Returns whether the invariants of a channel hold between frames. For assertions.
[[maybe_unused]] bool is_consistent(const CO_SDO& channel) {
  bool is_valid = channel.Flow.State != 0 || channel.Obj == nullptr;
#if USE_SDO_BLOCK
  constexpr uint8_t most = 127;
  is_valid =
      is_valid && channel.Flow.Seq <= most && channel.Flow.AckSeq <= most && channel.Flow.Fill <= CO_SDO_BUF_BYTE;
#endif
  return is_valid;
}

// Not inlined: relative to a pointer to the channel, all members are reached by short loads.
[[gnu::noinline]] bool process_frame(CO_SDO& channel, const CO_IF_FRM& frame) {
  if (frame.DLC != wire::sdo_dlc) {
    return false;
  }
  CO_OBJ* found = nullptr;
  if (USE_FAST_PATHS != 0 && answer_at_once(channel, frame, found)) {
    return true;
  }
  const bool in_block = is_segment(channel, frame);
  if (has_block && in_block && !store_in_block(channel, frame)) {
    return true;
  }
  const Request request = in_block ? Request::block_segment : wire::request_of(frame.Data[0]);
  if (has_block && request == Request::acknowledge_block && state_of(channel) == State::block_upload_end) {
    return true;  // repeated, because the client waits for the end message
  }
  if (!in_block) {
    channel.Flow.Idle = 0;
  }
  run_handler(channel, state_machine(state_of(channel), request), frame, found);
  return true;
}

// Returns the identifier in an entry, or no_frame. Without an entry the default server uses the predefined identifiers.
// [301:7.3.5]
[[gnu::noinline]] uint32_t identifier(CO_NODE& node, uint16_t number, uint8_t sub, wire::CobId base) {
  const uint32_t cob_id =
      dict::read_cob_id(node, CO_DEV(0x1200U + number, sub), number == 0 ? base + node.NodeId : wire::cob_invalid);
  return cob_id == wire::cob_invalid ? wire::no_frame : wire::frame_id(cob_id);
}

[[gnu::noinline]] void configure_channel(CO_SDO& channel) {
  CO_NODE& node = *channel.Node;
  const auto number = static_cast<uint16_t>(CO_SSDO_N == 1 ? 0 : &channel - node.Sdo);
  uint32_t rx_id = identifier(node, number, 1, wire::CobId::sdo_rx);
  uint32_t tx_id = identifier(node, number, 2, wire::CobId::sdo_tx);
  if (rx_id == wire::no_frame || tx_id == wire::no_frame) {
    rx_id = wire::no_frame;
    tx_id = wire::no_frame;
  }
  if (channel.RxId == rx_id && channel.TxId == tx_id) {
    return;
  }
  close(channel, Abort::device_state);
  channel.RxId = rx_id;
  if (channel.TxId != tx_id) {  // a response in the transmit queue keeps the previous identifier
    transmit::withdraw(node, channel.WasTxId);
    channel.WasTxId = channel.TxId;
    channel.TxId = tx_id;
  }
  routes::change(node, rx_id, routes::owner<PartId::sdo_server>(number));
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
  tmr::stop(node, node.SdoTmr);
  configure(node);
}

void configure(CO_NODE& node) {
  for (CO_SDO& channel : node.Sdo) {
    configure_channel(channel);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  CO_ASSERT(number < CO_SSDO_N && node.Sdo[number].Node == &node && is_consistent(node.Sdo[number]));
  const bool is_valid = process_frame(node.Sdo[number], frame);
  CO_ASSERT(is_consistent(node.Sdo[number]));
  return is_valid;
}

#if USE_SDO_BLOCK
namespace {

Abort send_next(CO_SDO& channel, const CO_IF_FRM&, CO_IF_FRM& answer, CO_OBJ*) {
  silence(answer);
  return send_segments(channel);
}

// Not inlined, as process_frame().
[[gnu::noinline]] bool continue_upload(CO_SDO& channel) {
  if (state_of(channel) != State::block_upload) {
    return false;
  }
  const uint8_t before = channel.Flow.Seq;
  run_handler(channel, send_next, wire::empty_frame(wire::no_frame), nullptr);
  if (channel.Flow.Seq == before) {
    return false;
  }
  channel.Flow.Idle = 0;
  return true;
}

}  // namespace

bool on_free(CO_NODE& node, uint16_t number) {
  CO_ASSERT(number < CO_SSDO_N);
  return continue_upload(node.Sdo[number]);
}
#else
bool on_free(CO_NODE&, uint16_t) { return false; }
#endif

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_SDO& channel : node.Sdo) {
    close(channel, Abort::device_state);
    transmit::withdraw(node, channel.TxId);
    transmit::withdraw(node, channel.WasTxId);
  }
  stop_idle_timer(node);
}

}  // namespace co::sdo::server
