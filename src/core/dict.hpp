// SPDX-License-Identifier: Apache-2.0
// Look-up in the sorted table.
#pragma once

#include "co_dict.h"

namespace co::dict {

[[nodiscard]] CO_OBJ* find(CO_DICT& dict, uint32_t key);

// Is there an entry with this index, at whatever sub-index?
[[nodiscard]] bool has_index(const CO_DICT& dict, uint32_t key);

[[nodiscard]] CO_ERR read_u32(CO_DICT& dict, uint32_t key, uint32_t& value);
[[nodiscard]] CO_ERR read_u16(CO_DICT& dict, uint32_t key, uint16_t& value);

}  // namespace co::dict
