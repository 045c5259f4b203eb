// SPDX-License-Identifier: Apache-2.0
// 1200h…12FFh, sub 1 and 2: COB-IDs of the SDO servers and clients. [301:7.5.2.33-34]
#include "co_sdo.h"

#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/cob_id.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"

namespace {

using namespace co;

bool is_valid(uint32_t cob_id) { return (cob_id & wire::cob_invalid) == 0; }

// Returns whether a CAN-ID is allowed. A client may use the CAN-IDs of another node's default SDO server.
bool may_use(const CO_OBJ& obj, uint32_t id) {
  constexpr uint16_t first_client = 0x1280;
  const bool of_client = CO_GET_IDX(obj.Key) >= first_client;
  const bool of_server = CO_GET_SUB(obj.Key) == 1 ? wire::is_default_sdo_rx(id) : wire::is_default_sdo_tx(id);
  return id != 0 && (CO_RESTRICTED_IDS != 0 || !wire::is_restricted(id) || (of_client && of_server));
}

bool is_allowed(const CO_OBJ& obj, uint32_t before, uint32_t value) {
  if (!is_valid(value) || value == before) {
    return true;
  }
  return !is_valid(before) && wire::fits_format(value) && may_use(obj, value & wire::extended_ids);
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const CO_ERR err = cob_id::write(*obj, *node, buffer, size, is_allowed);
  if (err == CO_ERR_NONE) {
    event::defer(*node, event::configure);
  }
  return err;
}

}  // namespace

extern "C" const CO_OBJ_TYPE COTSdoId = {co::integer::Number<4>::size, dict::checked_by<rules::sdo_cob_id>,
                                         cob_id::read, write, nullptr};
