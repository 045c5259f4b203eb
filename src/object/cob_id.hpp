// SPDX-License-Identifier: Apache-2.0
// Objects that hold a COB-ID: UNSIGNED32, of which flag N makes the CAN-ID relative to the node-ID.
#pragma once

#include "co_core.h"

namespace co::cob_id {

[[nodiscard]] uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width);

// The COB-ID as the network sees it; as Read of a type.
[[nodiscard]] CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size);

// May the value take the place of the one before?
using Permission = bool (*)(const CO_OBJ& obj, uint32_t before, uint32_t value);

// Stores what the permission allows, else CO_ERR_OBJ_RANGE; buffer and size as Write of a type.
[[nodiscard]] CO_ERR write(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size, Permission may);

// Is this a CAN-ID that a configurable object may have, in the format that bit 29 names? [301:7.3.5]
[[nodiscard]] bool is_free(uint32_t cob_id);

// The rule of most objects: while bit 31 of neither is set, nothing changes; while it is, anything that is free may
// come.
[[nodiscard]] bool may_replace(uint32_t before, uint32_t value);

}  // namespace co::cob_id
