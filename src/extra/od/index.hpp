// SPDX-License-Identifier: Apache-2.0
// Index of a dictionary: an OD_entry_t for each object of the table.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

// Returns whether OD_init() has generated the entry from a table; other entries describe memory only.
[[nodiscard]] inline bool is_of_table(const OD_entry_t& entry) {
  return (entry.odObjectType & ODT_TABLE) != 0 && entry.odObject != nullptr;
}
// Returns the OD_t of an entry that OD_init() has generated.
[[nodiscard]] inline OD_t& owner_of(const OD_entry_t& entry) {
  return *static_cast<OD_t*>(const_cast<void*>(entry.odObject));
}

// Returns the entry of the table, or null.
[[nodiscard]] CO_OBJ* find_in_table(const OD_t& od, uint32_t key);
[[nodiscard]] inline CO_OBJ* find_in_table(const OD_entry_t& entry, uint8_t sub) {
  return is_of_table(entry) ? find_in_table(owner_of(entry), CO_DEV(entry.index, sub)) : nullptr;
}

// Returns the extension of an object of the node, or null.
[[nodiscard]] OD_extension_t* extension_of(const CO_NODE& node, const CO_OBJ& obj);

}  // namespace co::od
