// SPDX-License-Identifier: Apache-2.0
// Objects that hold a COB-ID: UNSIGNED32; with flag N the CAN-ID is stored relative to the node-ID.
#pragma once

#include "co_core.h"

namespace co::cob_id {

// Reads the COB-ID that the network sees. Parameters of a type's Read function.
[[nodiscard]] CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);

// Function that returns whether value may replace before.
using Permission = bool (*)(const CO_OBJ& obj, uint32_t before, uint32_t value);

// Writes a COB-ID if the permission allows it, else returns CO_ERR_OBJ_RANGE. buffer and size: those of a type's Write
// function.
[[nodiscard]] CO_ERR write(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size, Permission may);

// Returns whether a configurable object may have this CAN-ID, in the frame format that bit 29 selects. [301:7.3.5]
[[nodiscard]] bool is_free(uint32_t cob_id);

// Permission of most objects: a value with bit 31 set (not valid) may always be written; a valid COB-ID only if it is
// unchanged, or if the COB-ID before is not valid and is_free() permits the CAN-ID.
[[nodiscard]] bool may_replace(uint32_t before, uint32_t value);

}  // namespace co::cob_id
