// SPDX-License-Identifier: Apache-2.0
// 1200h…12FFh, sub 1 and 2: COB-IDs of the SDO servers and clients. [301:7.5.2.33-34]
#include "co_sdo.h"

#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"

namespace co::sdo_id {
namespace {

// Returns whether a valid COB-ID is allowed. A client may use the CAN-IDs of another node's default SDO server.
bool may_use(const CO_OBJ& obj, uint32_t cob_id) {
  constexpr uint16_t first_client = 0x1280;
  const uint32_t id = cob_id & wire::extended_ids;
  const bool of_server = CO_GET_SUB(obj.Key) == 1 ? wire::is_default_sdo_rx(id) : wire::is_default_sdo_tx(id);
  return cob_id::is_free(cob_id) || (of_server && CO_GET_IDX(obj.Key) >= first_client);
}

CO_ERR may_replace(CO_NODE&, CO_OBJ& obj, uint32_t value, uint32_t before) {
  if (!wire::is_valid(value) || value == before) {
    return CO_ERR_NONE;
  }
  return wire::is_valid(before) || !may_use(obj, value) ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

void configure(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) { event::defer(node, event::configure); }

}  // namespace
}  // namespace co::sdo_id

extern "C" const CO_OBJ_TYPE COTSdoId =
    co::parameter<co::integer::cob_id, co::rules::sdo_cob_id, co::sdo_id::may_replace, co::sdo_id::configure>;
