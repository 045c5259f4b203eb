// SPDX-License-Identifier: Apache-2.0
// 1200h…12FFh, sub 1 and 2: COB-IDs of the SDO servers and clients. [301:7.5.2.33-34]
#include "co_sdo.h"

#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/parameter.hpp"
#include "wire/cob_id.hpp"

namespace {

using namespace co;

// Returns whether a CAN-ID is allowed. A client may use the CAN-IDs of another node's default SDO server.
bool may_use(const CO_OBJ& obj, uint32_t id) {
  constexpr uint16_t first_client = 0x1280;
  const bool of_client = CO_GET_IDX(obj.Key) >= first_client;
  const bool of_server = CO_GET_SUB(obj.Key) == 1 ? wire::is_default_sdo_rx(id) : wire::is_default_sdo_tx(id);
  return id != 0 && (CO_RESTRICTED_IDS != 0 || !wire::is_restricted(id) || (of_client && of_server));
}

bool is_allowed(const CO_OBJ& obj, uint32_t value, uint32_t before) {
  if (!wire::is_valid(value) || value == before) {
    return true;
  }
  return !wire::is_valid(before) && wire::fits_format(value) && may_use(obj, value & wire::extended_ids);
}

CO_ERR may_replace(CO_NODE&, CO_OBJ& obj, uint32_t value, uint32_t before) {
  return is_allowed(obj, value, before) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void configure(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) { event::defer(node, event::configure); }

}  // namespace

extern "C" const CO_OBJ_TYPE COTSdoId = parameter<integer::cob_id, rules::sdo_cob_id, may_replace, configure>;
