// SPDX-License-Identifier: Apache-2.0
// 1014h, COB-ID EMCY. [301:7.5.2.17]
#include "service/emcy/emcy.hpp"

#if USE_EMCY

#include "dictionary/dict.hpp"
#include "dictionary/types/cob_id.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"

namespace co::emcy {
namespace {

constexpr uint32_t reserved = 1U << 30;

bool is_valid(uint32_t cob_id) { return (cob_id & wire::cob_invalid) == 0; }

// Returns whether a COB-ID may be written. A restricted CAN-ID is refused in a COB-ID that is not valid, too. [P5]
bool may_replace(const CO_OBJ&, uint32_t before, uint32_t value) {
  const bool is_usable = cob_id::is_free(value) && (value & reserved) == 0;
  return value == before || (is_usable && !(is_valid(before) && is_valid(value)));
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  const uint32_t before = identifier(*node);
  const CO_ERR err = cob_id::write(*obj, *node, buffer, size, may_replace);
  if (identifier(*node) == wire::no_frame) {
    withdraw(*node, before);
  }
  return err;
}

}  // namespace
}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyId = {co::integer::Number<4>::size, co::dict::checked_by<co::rules::emcy_cob_id>,
                                          co::cob_id::read, co::emcy::write, nullptr};

#endif
