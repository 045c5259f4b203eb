// SPDX-License-Identifier: Apache-2.0
// The SDO client parameter: COB-IDs and the node-ID of the server. [301:7.5.2.34]
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"
#include "service/sdo/client.hpp"
#include "wire/cob_id.hpp"

#if USE_CSDO

namespace co::sdo::client {
namespace {

struct Configuration {
  uint32_t tx_id;
  uint32_t rx_id;
  uint8_t node_id;
  CO_CSDO_STATE state;  // idle: the client is configured
};

// Returns whether the COB-IDs are 600h and 580h: the node-ID of the server (sub-index 3) is added to them.
bool are_bases(uint32_t tx, uint32_t rx) {
  return tx == wire::CobId::sdo_rx + uint8_t{0} && rx == wire::CobId::sdo_tx + uint8_t{0};
}

// Reads 1280h + number. A client whose server is this node accesses the own dictionary and has no identifiers.
Configuration read_configuration(CO_NODE& node, uint16_t number) {
  constexpr uint8_t last_node_id = 127;
  Configuration found = {wire::no_frame, wire::no_frame, 0, CO_CSDO_STATE_INVALID};
  const uint32_t tx = dict::read_cob_id(node, CO_DEV(0x1280U + number, 1), wire::cob_invalid);
  const uint32_t rx = dict::read_cob_id(node, CO_DEV(0x1280U + number, 2), wire::cob_invalid);
  found.node_id = static_cast<uint8_t>(dict::read_number(node, CO_DEV(0x1280U + number, 3), sizeof found.node_id, 0));
  const bool is_relative = are_bases(tx, rx);
  const uint32_t relative = is_relative ? found.node_id : 0;
  if (tx == wire::cob_invalid || rx == wire::cob_invalid || (is_relative && relative - 1 >= last_node_id)) {
    return found;
  }
  const bool is_own = found.node_id == node.NodeId;
  if (!is_own) {
    found.tx_id = cob_id::identifier(tx + relative);
    found.rx_id = cob_id::identifier(rx + relative);
  }
  found.state = is_own && !has_own ? CO_CSDO_STATE_INVALID : CO_CSDO_STATE_IDLE;
  return found;
}

bool is_configured(const CO_CSDO& client, const Configuration& as) {
  const bool is_off = client.State == CO_CSDO_STATE_INVALID;
  return client.TxId == as.tx_id && client.RxId == as.rx_id && client.NodeId == as.node_id &&
         is_off == (as.state == CO_CSDO_STATE_INVALID);
}

uint16_t number_of(const CO_CSDO& client) {
  return static_cast<uint16_t>(CO_CSDO_N == 1 ? 0 : &client - client.Node->CSdo);
}

void apply_configuration(CO_CSDO& client, const Configuration& found) {
  CO_NODE& node = *client.Node;
  if (client.TxId != found.tx_id) {  // an abort in the transmit queue keeps the previous identifier
    transmit::withdraw(node, client.WasTxId);
    client.WasTxId = client.TxId;
    client.TxId = found.tx_id;
  }
  client.RxId = found.rx_id;
  client.NodeId = found.node_id;
  client.State = found.state;
  routes::change(node, found.rx_id, routes::owner<PartId::sdo_client>(number_of(client)));
}

// Configures a client if its parameter has changed; a transfer in progress is aborted. Returns whether routes have
// changed. The callback of the aborted transfer may already have configured the client, or started another transfer:
// the parameter is read again.
bool configure_client(CO_CSDO& client) {
  bool is_aborted = false;
  for (;;) {
    const Configuration found = read_configuration(*client.Node, number_of(client));
    if (is_configured(client, found)) {
      return is_aborted;
    }
    if (client.State != CO_CSDO_STATE_BUSY) {
      apply_configuration(client, found);
      return true;
    }
    if (is_aborted) {
      return false;
    }
    abort_transfer(client, Abort::device_state);
    is_aborted = true;
  }
}

}  // namespace

void configure(CO_NODE& node) {
  for (CO_CSDO& client : node.CSdo) {
    configure_client(client);
  }
}

void refresh(CO_CSDO& client) {
  if (client.State != CO_CSDO_STATE_BUSY && configure_client(client)) {
    routes::publish(*client.Node);
  }
}

}  // namespace co::sdo::client

#endif
