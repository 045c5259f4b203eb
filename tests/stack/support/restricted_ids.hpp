// SPDX-License-Identifier: Apache-2.0
/// \file restricted_ids.hpp
/// CAN-IDs that CiA 301 reserves.
#pragma once

#include <cstdint>

#include "co_cfg.h"

namespace test {

/// Returns true if no PDO, SYNC, TIME, EMCY or SDO may use the 11-bit CAN-ID \a id. [301:7.3.5]
constexpr bool is_restricted(std::uint32_t id) {
  return id <= 0x07F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) ||
         (id >= 0x6E0 && id <= 0x6FF) || (id >= 0x701 && id <= 0x7FF);
}

/// Returns true if this configuration (CO_RESTRICTED_IDS) rejects \a id. 000h is rejected always: it belongs to NMT.
constexpr bool is_forbidden(std::uint32_t id) { return id == 0 || (CO_RESTRICTED_IDS == 0 && is_restricted(id)); }

}  // namespace test
