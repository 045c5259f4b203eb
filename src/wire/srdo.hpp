// SPDX-License-Identifier: Apache-2.0
// COB-IDs, values and frames of SRDOs. [EN 50325-5]
#pragma once

#include "lexican/srdo.hpp"
#include "wire/bytes.hpp"

namespace co::wire {

constexpr bool is_srdo_plain_id(uint32_t cob_id) { return cob_id >= 0x101 && cob_id <= 0x17F && cob_id % 2 == 1; }
constexpr bool is_srdo_inverse_id(uint32_t cob_id) { return cob_id != 0 && is_srdo_plain_id(cob_id - 1); }

// Returns whether all bits of the bytes differ.
constexpr bool is_inverse(const uint8_t* plain, const uint8_t* inverse, unsigned bytes) {
  unsigned equal = 0;
  for (unsigned n = 0; n < bytes; ++n) {
    equal |= 0xFFU & ~(unsigned{plain[n]} ^ inverse[n]);
  }
  return equal == 0;
}

static_assert(is_srdo_plain_id(0x101) && is_srdo_plain_id(0x17F) && !is_srdo_plain_id(0x102));
static_assert(!is_srdo_plain_id(0x0FF) && !is_srdo_plain_id(0x181) && !is_srdo_plain_id(0x20000101));
static_assert(is_srdo_inverse_id(0x102) && is_srdo_inverse_id(0x180) && !is_srdo_inverse_id(0x100));

namespace vectors {
inline constexpr uint8_t srdo_plain[] = {0x00, 0xA5};
inline constexpr uint8_t srdo_inverse[] = {0xFF, 0x5A};
static_assert(is_inverse(srdo_plain, srdo_inverse, 2) && !is_inverse(srdo_plain, srdo_plain, 1));
}  // namespace vectors

}  // namespace co::wire
