// SPDX-License-Identifier: Apache-2.0
#include "dictionary/dict.hpp"

#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/access.hpp"
#include "dictionary/obj.hpp"
#include "wire/cob_id.hpp"

namespace co::dict {

uint32_t first_from(const CO_OBJ* root, uint32_t num, uint32_t key) {
  uint32_t from = 0;
  uint32_t to = num;
  while (from < to) {
    const uint32_t middle = (from + to) / 2;
    if (root[middle].Key < key) {
      from = middle + 1;
    } else {
      to = middle;
    }
  }
  return from;
}

uint16_t count_entries(const CO_OBJ* root, uint16_t max) {
  uint16_t num = 0;
  while (num < max && !rules::is_end(root[num].Key)) {
    ++num;
  }
  return num;
}

namespace {

// Returns the end mark if it has a type for power-on values, else null. The other members of an end mark with key 0 may
// hold any values.
CO_OBJ* typed_end(CO_OBJ* root, uint16_t num, uint16_t max) {
  const bool is_typed = num < max && root[num].Key == CO_DEFAULTS_KEY && root[num].Type != nullptr;
  return is_typed && root[num].Type->Reset != nullptr ? &root[num] : nullptr;
}

#if USE_DICT_CHECK
CO_ERR check(CO_DICT& dict) {
  uint32_t key_before = 0;
  for (uint16_t n = 0; n < dict.Num; ++n) {
    const CO_OBJ& entry = dict.Root[n];
    dict.Fault = rules::check_entry(key_before, entry.Key, entry.Type != nullptr, false);
    if (dict.Fault != CO_DICT_OK) {
      dict.FaultKey = entry.Key;
      return CO_ERR_DICT_INIT;
    }
    key_before = entry.Key;
  }
  return CO_ERR_NONE;
}
#else
CO_ERR check(CO_DICT&) { return CO_ERR_NONE; }
#endif

// Reads or writes a value of width bytes through the type of its entry, from position 0. Returns CO_ERR_OBJ_SIZE if the
// object has another length.
CO_ERR access(CO_DICT* dict, uint32_t key, void* value, uint32_t width,
              CO_ERR (*run)(CO_OBJ&, CO_NODE_T&, void*, uint32_t)) {
  if (dict == nullptr || dict->Node == nullptr || value == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const found = find(*dict, key);
  if (found == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  if (obj::size(*found, *dict->Node, width) != width) {
    return CO_ERR_OBJ_SIZE;
  }
  const CO_ERR err = obj::seek(*found, *dict->Node, 0);
  return err != CO_ERR_NONE ? err : run(*found, *dict->Node, value, width);
}

}  // namespace

#if USE_FAST_PATHS

namespace {

// Returns the highest key that an entry with this index and sub-index can have: the lowest 8 bits are flags.
constexpr uint32_t bound_of(uint32_t key) { return key | 0xFFU; }

// Returns whether an entry has the index and sub-index to which bound belongs.
constexpr bool is_within(uint32_t entry_key, uint32_t bound) { return bound - entry_key <= 0xFFU; }

template <unsigned entries>
inline CO_OBJ* step(CO_OBJ* from, uint32_t bound) {
  return from[entries].Key <= bound ? from + entries : from;
}

// Searches 2^steps entries (binary search, unrolled): no branch depends on the result of a comparison, and all offsets
// are constants. Returns the last entry whose key is not above bound, or the first entry.
[[gnu::always_inline]] inline CO_OBJ* search_unrolled(CO_OBJ* from, uint8_t steps, uint32_t bound) {
  switch (steps) {
    case 15: from = step<1U << 14>(from, bound); [[fallthrough]];
    case 14: from = step<1U << 13>(from, bound); [[fallthrough]];
    case 13: from = step<1U << 12>(from, bound); [[fallthrough]];
    case 12: from = step<1U << 11>(from, bound); [[fallthrough]];
    case 11: from = step<1U << 10>(from, bound); [[fallthrough]];
    case 10: from = step<1U << 9>(from, bound); [[fallthrough]];
    case 9: from = step<1U << 8>(from, bound); [[fallthrough]];
    case 8: from = step<1U << 7>(from, bound); [[fallthrough]];
    case 7: from = step<1U << 6>(from, bound); [[fallthrough]];
    case 6: from = step<1U << 5>(from, bound); [[fallthrough]];
    case 5: from = step<1U << 4>(from, bound); [[fallthrough]];
    case 4: from = step<1U << 3>(from, bound); [[fallthrough]];
    case 3: from = step<1U << 2>(from, bound); [[fallthrough]];
    case 2: from = step<1U << 1>(from, bound); [[fallthrough]];
    case 1: from = step<1U << 0>(from, bound); [[fallthrough]];
    case 0: break;
    default: __builtin_unreachable();  // more than 15 steps: a table has at most 65535 entries
  }
  return from;
}

// Returns the last entry whose key is not above bound, or the first entry of the table. The table must not be empty.
[[gnu::always_inline]] inline CO_OBJ* last_not_behind(const CO_DICT& dict, uint32_t bound) {
  return search_unrolled(dict.Split->Key <= bound ? dict.Split : dict.Root, dict.Steps, bound);
}

// Prepares the binary search. It searches one of two parts of the table that overlap: the first 2^Steps entries, from
// Root, or the last 2^Steps, from Split. 2^Steps is the largest power of two that is not above the number of entries.
void prepare_search(CO_DICT& dict) {
  uint32_t half = 1;
  while (half * 2 <= dict.Num) {
    half *= 2;
    ++dict.Steps;
  }
  dict.Split = dict.Root + (dict.Num - half);
  dict.Last = dict.Root + (dict.Num - 1);
  dict.Next = dict.Root;
}

}  // namespace

// Compares the entry behind the one found last first: most accesses are to the next sub-index.
CO_OBJ* find(CO_DICT& dict, uint32_t key) {
  CO_OBJ* found = dict.Next;
  if (found == nullptr) {  // an empty table
    return nullptr;
  }
  const uint32_t bound = bound_of(key);
  if (!is_within(found->Key, bound)) {
    found = last_not_behind(dict, bound);
    if (!is_within(found->Key, bound)) {
      return nullptr;
    }
  }
  dict.Next = found == dict.Last ? dict.Root : found + 1;
  return found;
}

#else

namespace {

void prepare_search(CO_DICT&) {}

}  // namespace

CO_OBJ* find(CO_DICT& dict, uint32_t key) {
  const uint32_t place = first_from(dict.Root, dict.Num, CO_GET_DEV(key));
  CO_OBJ* const found = &dict.Root[place];
  return place < dict.Num && CO_GET_DEV(found->Key) == CO_GET_DEV(key) ? found : nullptr;
}

#endif

void set_power_on_values(CO_NODE& node, CO_NMT_RESET type) {
  CO_OBJ* const end = node.Dict.End;
  if (end != nullptr) {
    (void)end->Type->Reset(end, &node, type);
  }
}

// Uses first_from(), which is slower than find() and needs no prepared search: called only after find() has failed.
bool has_index(const CO_DICT& dict, uint32_t key) {
  const uint32_t place = first_from(dict.Root, dict.Num, CO_DEV(CO_GET_IDX(key), 0));
  return place < dict.Num && CO_GET_IDX(dict.Root[place].Key) == CO_GET_IDX(key);
}

#if USE_DICT_CHECK
CO_ERR set_fault(const CO_OBJ& obj, CO_NODE_T& node, CO_DICT_FAULT fault) {
  if (node.Dict.Fault == CO_DICT_OK || (rules::stops_node(fault) && !stops_node(node.Dict))) {
    node.Dict.Fault = fault;
    node.Dict.FaultKey = obj.Key;
  }
  return CO_ERR_TYPE_INIT;
}

CO_ERR check_type(const CO_OBJ& obj, CO_NODE_T& node, const rules::Rule& rule) {
  const CO_DICT_FAULT fault = rules::check_type(rule, obj.Key, uintptr_t{obj.Data} != 0);
  return fault == CO_DICT_OK ? CO_ERR_NONE : set_fault(obj, node, fault);
}
#endif

Initialised init_objects(CO_DICT& dict, CO_NODE& node) {
  Initialised result = {CO_ERR_NONE, 0};
  for (uint16_t n = 0; n < dict.Num; ++n) {
    CO_OBJ& entry = dict.Root[n];
    const CO_ERR err = COObjInit(&entry, &node);
    if (err != CO_ERR_NONE) {
      result = {err, result.key != 0 ? result.key : entry.Key};
    }
  }
  return result;
}

CO_ERR read_u32(CO_DICT& dict, uint32_t key, uint32_t& value) {
  return access(&dict, key, &value, sizeof value, obj::read);
}

uint32_t read_cob_id(CO_DICT& dict, uint32_t key, uint32_t otherwise) {
  uint32_t value = 0;
  if (read_u32(dict, key, value) != CO_ERR_NONE) {
    value = otherwise;
  }
  return wire::is_usable(value) ? value : wire::cob_invalid;
}

CO_ERR read_u16(CO_DICT& dict, uint32_t key, uint16_t& value) {
  return access(&dict, key, &value, sizeof value, obj::read);
}

CO_ERR write_u32(CO_DICT& dict, uint32_t key, uint32_t value) {
  return access(&dict, key, &value, sizeof value, obj::write);
}

}  // namespace co::dict

using namespace co;

namespace {

CO_OBJ* find_entry(CO_DICT* cod, uint32_t key) { return cod == nullptr ? nullptr : dict::find(*cod, key); }

}  // namespace

extern "C" {

int16_t CODictInit(CO_DICT* cod, CO_NODE_T* node, CO_OBJ* root, uint16_t max) {
  if (cod == nullptr || node == nullptr || root == nullptr || max == 0) {
    return -1;
  }
  *cod = {};
  cod->Node = node;
  cod->Root = root;
  cod->Num = dict::count_entries(root, max);
  cod->End = dict::typed_end(root, cod->Num, max);
  const CO_ERR err = dict::check(*cod);
  if (err != CO_ERR_NONE) {
    cod->Num = 0;
  }
  if (cod->Num != 0) {
    dict::prepare_search(*cod);
  }
  access::close_moved(*node);
  event::defer(*node, event::remap);
  event::run_deferred(*node);
  if (err != CO_ERR_NONE) {
    return -1;
  }
  return static_cast<int16_t>(cod->Num < INT16_MAX ? cod->Num : INT16_MAX);
}

CO_ERR CODictObjInit(CO_DICT* cod, CO_NODE_T* node) {
  if (cod == nullptr || node == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  return dict::init_objects(*cod, *node).err;
}

CO_DICT_FAULT CODictGetFault(const CO_DICT* cod, uint32_t* key) {
  if (cod == nullptr) {
    return CO_DICT_OK;
  }
  if (key != nullptr) {
    *key = dict::fault_key_of(*cod);
  }
  return dict::fault_of(*cod);
}

CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key) { return find_entry(cod, key); }

CO_ERR CODictRdByte(CO_DICT* cod, uint32_t key, uint8_t* val) {
  return dict::access(cod, key, val, sizeof *val, obj::read);
}

CO_ERR CODictRdWord(CO_DICT* cod, uint32_t key, uint16_t* val) {
  return dict::access(cod, key, val, sizeof *val, obj::read);
}

CO_ERR CODictRdLong(CO_DICT* cod, uint32_t key, uint32_t* val) {
  return dict::access(cod, key, val, sizeof *val, obj::read);
}

CO_ERR CODictWrByte(CO_DICT* cod, uint32_t key, uint8_t val) {
  return dict::access(cod, key, &val, sizeof val, obj::write_for_application);
}

CO_ERR CODictWrWord(CO_DICT* cod, uint32_t key, uint16_t val) {
  return dict::access(cod, key, &val, sizeof val, obj::write_for_application);
}

CO_ERR CODictWrLong(CO_DICT* cod, uint32_t key, uint32_t val) {
  return dict::access(cod, key, &val, sizeof val, obj::write_for_application);
}

CO_ERR CODictRdBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len) {
  if (cod == nullptr || buf == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const found = find_entry(cod, key);
  return found == nullptr ? CO_ERR_OBJ_NOT_FOUND : COObjRdBufStart(found, cod->Node, buf, len);
}

CO_ERR CODictWrBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len) {
  if (cod == nullptr || buf == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  CO_OBJ* const found = find_entry(cod, key);
  return found == nullptr ? CO_ERR_OBJ_NOT_FOUND : COObjWrBufStart(found, cod->Node, buf, len);
}

}  // extern "C"
