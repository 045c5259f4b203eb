// SPDX-License-Identifier: Apache-2.0
// 1014h, COB-ID EMCY. [301:7.5.2.17]
#include "service/emcy/emcy.hpp"

#if USE_EMCY

#include "dictionary/parameter.hpp"
#include "dictionary/types/cob_id.hpp"
#include "wire/cob_id.hpp"

namespace co::emcy {
namespace {

constexpr uint32_t reserved = 1U << 30;

// Checks a COB-ID. A restricted CAN-ID is refused in a COB-ID that is not valid, too. [P5]
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  if (value == before) {
    return CO_ERR_NONE;
  }
  const bool is_change = wire::is_valid(before) && wire::is_valid(value);
  return is_change || (value & reserved) != 0 || !cob_id::is_free(value) ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

// Drops the messages that wait with the identifier before, if there is no new one.
void apply(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t before) {
  if (!wire::is_valid(value)) {
    withdraw(node, cob_id::identifier(before));
  }
}

}  // namespace
}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyId =
    co::parameter<co::integer::cob_id, co::rules::emcy_cob_id, co::emcy::may_replace, co::emcy::apply>;

#endif
