// SPDX-License-Identifier: Apache-2.0
// Rules for the values of objects that hold a COB-ID.
#pragma once

#include <stdint.h>

namespace co::cob_id {

// Returns the identifier of frames with this COB-ID, wire::no_frame if there can be none (wire::is_usable()).
[[nodiscard]] uint32_t identifier(uint32_t cob_id);

// Returns whether a configurable object may have this CAN-ID, in the frame format that bit 29 selects. [301:7.3.5]
[[nodiscard]] bool is_free(uint32_t cob_id);

// Returns whether most objects permit a value: one with bit 31 set (not valid) may always be written; a valid COB-ID
// only if it is unchanged, or if the COB-ID before is not valid and is_free() permits the CAN-ID.
[[nodiscard]] bool may_replace(uint32_t before, uint32_t value);

}  // namespace co::cob_id
