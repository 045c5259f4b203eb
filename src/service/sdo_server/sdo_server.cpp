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
  close(step.channel);
  step.silent = true;
  return no_abort;
}

uint32_t refuse_command(Step&) { return CO_SDO_ERR_CMD; }

using Service = uint32_t (*)(Step&);
using SdoRow = Row<State, wire::Ccs, Service>;
using wire::Ccs;

// A new initiate in an open transfer drops that and is served: its client has started anew. [301:7.2.4.3]
constexpr SdoRow rows[] = {
    {State::idle, Ccs::initiate_download, initiate_download},
    {State::idle, Ccs::initiate_upload, initiate_upload},
    {State::idle, Ccs::abort, end_by_client},

    {State::download, Ccs::download_segment, download_segment},
    {State::download, Ccs::initiate_download, initiate_download},
    {State::download, Ccs::initiate_upload, initiate_upload},
    {State::download, Ccs::abort, end_by_client},

    {State::upload, Ccs::upload_segment, upload_segment},
    {State::upload, Ccs::initiate_download, initiate_download},
    {State::upload, Ccs::initiate_upload, initiate_upload},
    {State::upload, Ccs::abort, end_by_client},
};

constexpr Machine<State, Ccs, Service, static_cast<size_t>(State::count), wire::ccs_count> machine(rows,
                                                                                                   refuse_command);

// An abort names the transfer that it ends; without one, what the request names.
uint32_t aborted_key(const CO_SDO& channel, State before, const CO_IF_FRM& request) {
  const Ccs command = wire::ccs(request);
  const bool within = before != State::idle && command != Ccs::initiate_download && command != Ccs::initiate_upload;
  return within ? channel.Key : wire::multiplexer(request);
}

uint32_t run(Step& step) {
  CO_SDO& channel = step.channel;
  const State state = state_of(channel);
  channel.Idle = 0;
  channel.UserAbort = 0;
  channel.Flags |= busy;
  const uint32_t result = machine(state, wire::ccs(step.request))(step);
  channel.Flags &= static_cast<uint8_t>(~busy);
  if (state_of(channel) != State::idle) {
    watch(step.node);
  }
  return result;
}

uint32_t cob_id(CO_NODE& node, uint32_t number, uint8_t sub, uint32_t otherwise) {
  uint32_t value = otherwise;
  const CO_ERR err = dict::read_u32(node.Dict, CO_DEV(0x1200U + number, sub), value);
  return err == CO_ERR_NONE ? value : otherwise;
}

// The identifier 000h belongs to NMT, whatever a table says.
bool is_usable(uint32_t cob_id) {
  return (cob_id & wire::cob_invalid) == 0 && wire::fits_format(cob_id) && (cob_id & wire::extended_ids) != 0;
}

void configure_channel(CO_NODE& node, uint16_t number) {
  CO_SDO& channel = node.Sdo[number];
  const bool is_default = number == 0;
  const uint32_t rx = cob_id(node, number, 1, is_default ? wire::CobId::sdo_rx + node.NodeId : wire::cob_invalid);
  const uint32_t tx = cob_id(node, number, 2, is_default ? wire::CobId::sdo_tx + node.NodeId : wire::cob_invalid);
  const bool valid = is_usable(rx) && is_usable(tx);
  const uint32_t rx_id = valid ? wire::frame_id(rx) : wire::no_frame;
  const uint32_t tx_id = valid ? wire::frame_id(tx) : wire::no_frame;
  if (channel.RxId == rx_id && channel.TxId == tx_id) {
    return;
  }
  close(channel);
  channel.RxId = rx_id;
  channel.TxId = tx_id;
  routes::remove(node, service, number);
  if (valid) {
    routes::add(node, rx_id, service, number);
  }
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
  if (frame.DLC != wire::sdo_dlc) {
    return false;
  }
  CO_SDO& channel = node.Sdo[number];
  CO_IF_FRM answer = {channel.TxId, {}, wire::sdo_dlc};
  Step step = {node, channel, frame, answer, false};
  const State before = state_of(channel);
  const uint32_t abort = run(step);
  if (!event::is_allowed(node, CO_SDO_ALLOWED)) {  // a type function has changed the NMT state
    on_mode(node);
  } else if (abort != no_abort) {
    close(channel);
    send_abort(channel, aborted_key(channel, before, frame), abort);
  } else if (!step.silent) {
    transmit::send(node, answer);
  }
  return true;
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_SDO_ALLOWED)) {
    return;
  }
  for (CO_SDO& channel : node.Sdo) {
    if ((channel.Flags & busy) == 0) {
      close(channel);
    }
    transmit::withdraw(node, channel.TxId);
  }
  tmr::stop(node.Tmr, node.SdoTmr);
}

}  // namespace co::sdo_server

using namespace co;

extern "C" void COObjTypeUserSDOAbort(CO_OBJ* obj, CO_NODE_T* node, uint32_t abort) {
  if (obj == nullptr || node == nullptr) {
    return;
  }
  for (CO_SDO& channel : node->Sdo) {
    if (channel.Obj == obj && (channel.Flags & sdo_server::busy) != 0) {
      channel.UserAbort = abort;
    }
  }
}
