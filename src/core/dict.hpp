// SPDX-License-Identifier: Apache-2.0
// Look-up in the sorted table.
#pragma once

#include "co/rules.hpp"
#include "co_dict.h"

namespace co::dict {

[[nodiscard]] CO_OBJ* find(CO_DICT& dict, uint32_t key);

// Is there an entry with this index, at whatever sub-index?
[[nodiscard]] bool has_index(const CO_DICT& dict, uint32_t key);

// For the Init functions of types: CO_ERR_TYPE_INIT if the entry breaks the type's rule. The first one that does is
// named by CODictGetFault(), and keeps the node from starting.
[[nodiscard]] CO_ERR check_type(const CO_OBJ& obj, CO_NODE_T& node, const rules::Rule& rule);

[[nodiscard]] CO_ERR read_u32(CO_DICT& dict, uint32_t key, uint32_t& value);
// The COB-ID of an object, or what it is without an entry; wire::cob_invalid if it cannot be used.
[[nodiscard]] uint32_t read_cob_id(CO_DICT& dict, uint32_t key, uint32_t otherwise);
[[nodiscard]] CO_ERR read_u16(CO_DICT& dict, uint32_t key, uint16_t& value);

}  // namespace co::dict
