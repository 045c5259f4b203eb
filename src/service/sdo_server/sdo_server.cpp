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

uint32_t end_by_client(Step& step) {
  close(step.channel, wire::abort_code_in(step.request));
  step.silent = true;
  return no_abort;
}

uint32_t refuse_command(Step&) { return CO_SDO_ERR_CMD; }

using Service = uint32_t (*)(Step&);
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
#endif
};

constexpr auto machine =
    make_machine<State, static_cast<size_t>(State::count), wire::command_count>(rows, refuse_command);

// Segments of a block look like anything; the state tells them.
Request request_in(const CO_SDO& channel, const CO_IF_FRM& frame) {
  const bool in_block =
      USE_SDO_BLOCK != 0 && (state_of(channel) == State::block_download ||
                             (state_of(channel) == State::block_download_end && is_last_segment_again(channel, frame)));
  const uint8_t command = frame.Data[0];
  return in_block && command != wire::abort_command ? Request::block_segment : wire::request_of(command);
}

bool is_initiate(Request request) {
  return request == Request::initiate_download || request == Request::initiate_upload ||
         request == Request::initiate_block_download || request == Request::initiate_block_upload;
}

// A channel is busy while its type functions run: they may change the NMT state.
class Serving {
 public:
  explicit Serving(CO_SDO& channel) : channel_(channel) {
    set(channel_, busy);
    access::serve(*channel_.Node, channel_.Obj);
  }
  ~Serving() {
    clear(channel_, busy);
    channel_.Node->Served = nullptr;
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

 private:
  CO_SDO& channel_;
};

// What happened is over. Nothing is sent where SDO is no longer allowed. True: so is the transfer.
bool is_concluded(CO_SDO& channel, uint32_t key, uint32_t abort) {
  CO_NODE& node = *channel.Node;
  if (!event::is_allowed(node, CO_SDO_ALLOWED)) {
    on_mode(node);
    return true;
  }
  if (abort != no_abort) {
    send_abort(channel, key, abort);
    close(channel, abort);
    return true;
  }
  return false;
}

// Not inlined: a channel by itself lies within reach of short loads.
[[gnu::noinline]] void serve(CO_SDO& channel, const CO_IF_FRM& frame) {
  CO_NODE& node = *channel.Node;
  CO_IF_FRM answer = wire::empty_frame(channel.TxId);
  Step step = {node, channel, frame, answer, false};
  const Request request = request_in(channel, frame);
  // An abort names the transfer that it ends; without one, what the request names.
  const bool within = state_of(channel) != State::idle && !is_initiate(request);
  const uint32_t key = within ? channel.Key : wire::multiplexer(frame);
  uint32_t abort = no_abort;
  {
    const Serving serving(channel);
    channel.Idle = 0;
    abort = machine(state_of(channel), request)(step);
  }
  if (state_of(channel) != State::idle) {
    watch(node);
  }
  if (!is_concluded(channel, key, abort) && !step.silent) {
    transmit::send(node, answer);
  }
}

bool go_on(CO_SDO& channel) {
  uint32_t abort = no_abort;
  bool sent = false;
  {
    const Serving serving(channel);
    sent = send_segment(channel, abort);
  }
  if (state_of(channel) != State::idle) {
    watch(*channel.Node);
  }
  return !is_concluded(channel, channel.Key, abort) && sent;
}

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
  channel.TxId = tx_id;
  routes::change(node, rx_id, routes::Service::sdo_server, number);
}

}  // namespace

void init(CO_NODE& node) {
  for (CO_SDO& channel : node.Sdo) {
    channel = {};
    channel.Node = &node;
  }
  tmr::stop(node.Tmr, node.SdoTmr);
  configure(node);
}

void configure(CO_NODE& node) {
  for (uint16_t number = 0; number < CO_SSDO_N; ++number) {
    configure_channel(node, number);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  const bool well_formed = frame.DLC == wire::sdo_dlc;
  if (well_formed) {
    serve(node.Sdo[number], frame);
  }
  return well_formed;
}

bool on_free(CO_NODE& node, uint16_t number) {
  CO_SDO& channel = node.Sdo[number];
  return USE_SDO_BLOCK != 0 && state_of(channel) == State::block_upload && go_on(channel);
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_SDO& channel : node.Sdo) {
    if (!has(channel, busy)) {
      close(channel, CO_SDO_ERR_TOS_STATE);
    }
    transmit::withdraw(node, channel.TxId);
  }
  tmr::stop(node.Tmr, node.SdoTmr);
}

}  // namespace co::sdo_server
