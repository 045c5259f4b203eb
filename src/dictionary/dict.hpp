// SPDX-License-Identifier: Apache-2.0
// Object dictionary: lookup in the sorted table of entries, checks of the entries, and access to single values.
#pragma once

#include "co_dict.h"
#include "lexican/detail/rules.hpp"

namespace co::dict {

// Returns the entry with the index and sub-index of key (flags are ignored); null: there is none.
[[nodiscard]] CO_OBJ* find(CO_DICT& dict, uint32_t key);
[[nodiscard]] CO_OBJ* find(CO_NODE_T& node, uint32_t key);
// Prepares the search of find() after the table has changed. The table must not be empty. Defined only if
// USE_FAST_PATHS is 1.
void prepare_search(CO_DICT& dict);

// Returns the number of entries before the end mark of a table, at most max.
[[nodiscard]] uint16_t count_entries(const CO_OBJ* root, uint16_t max);
// Returns the position of the first of num entries whose Key is not lower than key; num if there is none. Binary
// search.
[[nodiscard]] uint32_t first_from(const CO_OBJ* root, uint32_t num, uint32_t key);

// Replaces the table. Returns the error of check(); the dictionary is empty then. max: length of the array root
[[nodiscard]] CO_ERR set_table(CO_DICT& dict, CO_NODE_T& node, CO_OBJ* root, uint16_t max);

// Sets the variables that the table's end mark lists (CO_DEFAULTS) to their default values.
void set_power_on_values(CO_NODE_T& node, CO_NMT_RESET type);

// Returns whether an entry has the index of key, which find() has just not found.
[[nodiscard]] bool has_index(const CO_DICT& dict, uint32_t key);

// Faults of the dictionary. One fault is recorded for CODictGetFault(): the first one, except that a fault that stops
// the node replaces one that does not.
//
// set_fault(), check_type(): for the Init functions of types. set_fault() records a fault that no rule describes and
// returns CO_ERR_TYPE_INIT. check_type() checks the entry against the rule of its type; if the entry breaks the rule,
// records the fault and returns CO_ERR_TYPE_INIT.
// fault_of(), fault_key_of(): return the recorded fault, and the key of the entry that has it.
// check(): checks the keys of all entries.
// out_of_order(): returns the key of the first entry that is not above the one before it, or 0. CODictGetFault() calls
// it where USE_DICT_CHECK is 0, because no fault is recorded then.
#if USE_DICT_CHECK
CO_ERR set_fault(const CO_OBJ& obj, CO_NODE_T& node, CO_DICT_FAULT fault);
[[nodiscard]] CO_ERR check_type(const CO_OBJ& obj, CO_NODE_T& node, const rules::Rule& rule);
[[nodiscard]] inline CO_DICT_FAULT fault_of(const CO_DICT& dict) { return static_cast<CO_DICT_FAULT>(dict.Fault); }
[[nodiscard]] inline uint32_t fault_key_of(const CO_DICT& dict) { return dict.FaultKey; }
[[nodiscard]] CO_ERR check(CO_DICT& dict);
#else
inline CO_ERR set_fault(const CO_OBJ&, CO_NODE_T&, CO_DICT_FAULT) { return CO_ERR_TYPE_INIT; }
[[nodiscard]] inline CO_ERR check_type(const CO_OBJ&, CO_NODE_T&, const rules::Rule&) { return CO_ERR_NONE; }
[[nodiscard]] inline CO_DICT_FAULT fault_of(const CO_DICT&) { return CO_DICT_OK; }
[[nodiscard]] inline uint32_t fault_key_of(const CO_DICT&) { return 0; }
[[nodiscard]] uint32_t out_of_order(const CO_DICT& dict);
[[nodiscard]] inline CO_ERR check(CO_DICT&) { return CO_ERR_NONE; }
#endif

// Result of init_objects().
struct Initialised {
  CO_ERR err;    // the last error
  uint32_t key;  // key of the first entry that failed; 0: none
};
// Calls the Init functions of all entries, also after one has failed.
[[nodiscard]] Initialised init_objects(CO_DICT& dict, CO_NODE_T& node);

// Returns whether a fault was found that keeps the node from running.
[[nodiscard]] inline bool stops_node(const CO_DICT& dict) { return rules::stops_node(fault_of(dict)); }

// Init function that checks an entry against a rule.
template <const rules::Rule& rule>
CO_ERR init(CO_OBJ* obj, CO_NODE_T* node) {
  return check_type(*obj, *node, rule);
}

// Init function of a type that only checks entries against a rule; null where checks are switched off (USE_DICT_CHECK).
template <const rules::Rule& rule>
inline constexpr CO_OBJ_INIT_FUNC checked_by = USE_DICT_CHECK != 0 ? init<rule> : nullptr;

// Returns whether number is a valid index of an array of count elements, for types that derive the number from the
// index or sub-index of an entry. Compares only if USE_DICT_CHECK is 0: otherwise the entries are already checked.
[[nodiscard]] constexpr bool is_number(unsigned number, unsigned count) {
  return USE_DICT_CHECK != 0 || number < count;
}

// Returns the number in an entry; otherwise if there is no entry, or one with another width. width: bytes, up to 4
[[nodiscard]] uint32_t read_number(CO_NODE_T& node, uint32_t key, uint32_t width, uint32_t otherwise);
[[nodiscard]] uint32_t read_number(CO_NODE_T& node, CO_OBJ* obj, uint32_t width, uint32_t otherwise);
// Reads a value of exactly 4 bytes through the type of its entry. Returns CO_ERR_OBJ_NOT_FOUND, CO_ERR_OBJ_SIZE or the
// error of the type.
[[nodiscard]] CO_ERR read_u32(CO_NODE_T& node, uint32_t key, uint32_t& value);
// Returns the COB-ID of an object; if the object cannot be read, the COB-ID given as otherwise. Returns
// wire::cob_invalid if that COB-ID cannot be used (wire::is_usable()).
[[nodiscard]] uint32_t read_cob_id(CO_NODE_T& node, uint32_t key, uint32_t otherwise);
// Writes a value of 4 bytes, like read_u32() reads it. Unlike CODictWrLong(), does not run deferred work.
CO_ERR write_u32(CO_NODE_T& node, uint32_t key, uint32_t value);

}  // namespace co::dict
