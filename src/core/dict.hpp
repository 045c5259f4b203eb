// SPDX-License-Identifier: Apache-2.0
// Look-up in the sorted table.
#pragma once

#include "co/rules.hpp"
#include "co_dict.h"

namespace co::dict {

[[nodiscard]] CO_OBJ* find(CO_DICT& dict, uint32_t key);

// Of a table: its entries, up to the end mark; the number of the first that has this key or a higher one.
[[nodiscard]] uint16_t count_entries(const CO_OBJ* root, uint16_t max);
[[nodiscard]] uint32_t first_from(const CO_OBJ* root, uint32_t num, uint32_t key);

// Gives the variables that the end mark of the table names their default values.
void set_power_on_values(CO_NODE_T& node, CO_NMT_RESET type);

// Is there an entry with this index, at whatever sub-index?
[[nodiscard]] bool has_index(const CO_DICT& dict, uint32_t key);

// For the Init functions of types: returns CO_ERR_TYPE_INIT if the entry breaks the type's rule. CODictGetFault() names
// the first one that does; one that stops the node is named before one that does not. refuse: for what the rules do not
// know.
#if USE_DICT_CHECK
CO_ERR refuse(const CO_OBJ& obj, CO_NODE_T& node, CO_DICT_FAULT fault);
[[nodiscard]] CO_ERR check_type(const CO_OBJ& obj, CO_NODE_T& node, const rules::Rule& rule);
#else
inline CO_ERR refuse(const CO_OBJ&, CO_NODE_T&, CO_DICT_FAULT) { return CO_ERR_TYPE_INIT; }
[[nodiscard]] inline CO_ERR check_type(const CO_OBJ&, CO_NODE_T&, const rules::Rule&) { return CO_ERR_NONE; }
#endif

// What was found so, and where.
[[nodiscard]] inline CO_DICT_FAULT fault_of([[maybe_unused]] const CO_DICT& dict) {
#if USE_DICT_CHECK
  return static_cast<CO_DICT_FAULT>(dict.Fault);
#else
  return CO_DICT_OK;
#endif
}
[[nodiscard]] inline uint32_t fault_key_of([[maybe_unused]] const CO_DICT& dict) {
#if USE_DICT_CHECK
  return dict.FaultKey;
#else
  return 0;
#endif
}

// Outcome of the Init functions of all entries.
struct Initialised {
  CO_ERR err;    // the last error
  uint32_t key;  // of the first entry that failed; 0: none
};
[[nodiscard]] Initialised init_objects(CO_DICT& dict, CO_NODE_T& node);

// Has a fault been found that keeps the node from running?
[[nodiscard]] inline bool stops_node(const CO_DICT& dict) { return rules::stops_node(fault_of(dict)); }

template <const rules::Rule& rule>
CO_ERR init(CO_OBJ* obj, CO_NODE_T* node) {
  return check_type(*obj, *node, rule);
}

// The Init function of a type whose entries have a rule and nothing else to be initialised.
template <const rules::Rule& rule>
inline constexpr CO_OBJ_INIT_FUNC checked_by = USE_DICT_CHECK != 0 ? init<rule> : nullptr;

// For types that reach memory by the number that an entry's place gives, from 0: where nobody checks the dictionary it
// may be any.
[[nodiscard]] constexpr bool is_number(unsigned number, unsigned count) {
  return USE_DICT_CHECK != 0 || number < count;
}

[[nodiscard]] CO_ERR read_u32(CO_DICT& dict, uint32_t key, uint32_t& value);
// The COB-ID of an object, or what it is without an entry; wire::cob_invalid if it cannot be used.
[[nodiscard]] uint32_t read_cob_id(CO_DICT& dict, uint32_t key, uint32_t otherwise);
[[nodiscard]] CO_ERR read_u16(CO_DICT& dict, uint32_t key, uint16_t& value);
CO_ERR write_u32(CO_DICT& dict, uint32_t key, uint32_t value);

}  // namespace co::dict
