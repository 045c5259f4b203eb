// SPDX-License-Identifier: Apache-2.0
// 1200h…12FFh, sub 1 and 2: COB-IDs of the SDO servers and clients. [301:7.5.2.33-34]
#include "co_sdo_id.h"

#include "co_core.h"
#include "core/dict.hpp"
#include "core/events.hpp"
#include "wire/cob_id.hpp"

namespace {

using namespace co;

// The stored value holds the CAN-ID relative to the node-ID where the entry says so; flags stay as they are.
uint32_t shift_id(uint32_t cob_id, uint32_t by) {
  const uint32_t ids = (cob_id & wire::cob_frame) != 0 ? wire::extended_ids : wire::base_ids;
  return (cob_id & ~ids) | ((cob_id + by) & ids);
}

uint32_t node_id_of(const CO_OBJ& obj, const CO_NODE& node) { return CO_IS_NODEID(obj.Key) != 0 ? node.NodeId : 0U; }

bool is_valid(uint32_t cob_id) { return (cob_id & wire::cob_invalid) == 0; }

// A client may have the COB-IDs of another node's default SDO server.
bool may_use(const CO_OBJ& obj, uint32_t id) {
  constexpr uint16_t first_client = 0x1280;
  const bool of_client = CO_GET_IDX(obj.Key) >= first_client;
  const bool of_server = CO_GET_SUB(obj.Key) == 1 ? wire::is_default_sdo_rx(id) : wire::is_default_sdo_tx(id);
  return !wire::is_restricted(id) || (of_client && of_server);
}

bool is_allowed(const CO_OBJ& obj, uint32_t before, uint32_t value) {
  if (!is_valid(value) || value == before) {
    return true;
  }
  return !is_valid(before) && wire::fits_format(value) && may_use(obj, value & wire::extended_ids);
}

// UNSIGNED32 keeps the value. It takes the node-ID into account for the 32 bits as a whole, which could reach the flags
// above the CAN-ID; so what it adds or takes off is undone, and done for the CAN-ID alone.

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return CO_TUNSIGNED32->Size(obj, node, width); }

CO_ERR init(CO_OBJ* obj, CO_NODE* node) { return dict::check_type(*obj, *node, rules::sdo_cob_id); }

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t shown = 0;
  const CO_ERR err = CO_TUNSIGNED32->Read(obj, node, &shown, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const uint32_t node_id = node_id_of(*obj, *node);
  const uint32_t value = shift_id(shown - node_id, node_id);
  __builtin_memcpy(buffer, &value, sizeof value);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  uint32_t before = 0;
  CO_ERR err = read(obj, node, &before, size);
  if (err != CO_ERR_NONE) {
    return err;
  }
  uint32_t value = 0;
  __builtin_memcpy(&value, buffer, sizeof value);
  if (!is_allowed(*obj, before, value)) {
    return CO_ERR_OBJ_RANGE;
  }
  const uint32_t node_id = node_id_of(*obj, *node);
  uint32_t shown = shift_id(value, 0U - node_id) + node_id;
  err = CO_TUNSIGNED32->Write(obj, node, &shown, size);
  if (err == CO_ERR_NONE) {
    event::defer(*node, event::configure_sdo);
  }
  return err;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTSdoId = {size, init, read, write, nullptr};
