// SPDX-License-Identifier: Apache-2.0
#include "dictionary/types/cob_id.hpp"

#include "co_core.h"
#include "wire/cob_id.hpp"

namespace co::cob_id {

uint32_t identifier(uint32_t cob_id) { return wire::is_usable(cob_id) ? wire::frame_id(cob_id) : wire::no_frame; }

bool is_free(uint32_t cob_id) {
  const uint32_t id = cob_id & wire::extended_ids;
  const bool restricted = CO_RESTRICTED_IDS == 0 && wire::is_restricted(id);
  return id != 0 && wire::fits_format(cob_id) && !restricted;
}

bool may_replace(uint32_t before, uint32_t value) {
  return !wire::is_valid(value) || value == before || (!wire::is_valid(before) && is_free(value));
}

}  // namespace co::cob_id
