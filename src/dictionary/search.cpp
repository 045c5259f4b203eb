// SPDX-License-Identifier: Apache-2.0
// Search of an entry: optimised for speed, or in little flash.
#include "dictionary/dict.hpp"

#include "co_assert.h"

#if USE_FAST_PATHS

namespace co::dict {
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

}  // namespace

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

// Compares the entry behind the one found last first: most accesses are to the next sub-index.
CO_OBJ* find(CO_DICT& dict, uint32_t key) {
  CO_OBJ* found = dict.Next;
  if (found == nullptr) {  // an empty table
    return nullptr;
  }
  CO_ASSERT(found >= dict.Root && found <= dict.Last);
  const uint32_t bound = bound_of(key);
  if (!is_within(found->Key, bound)) {
    found = last_not_behind(dict, bound);
    if (!is_within(found->Key, bound)) {
      dict.Next = found;  // for has_index()
      return nullptr;
    }
  }
  dict.Next = found == dict.Last ? dict.Root : found + 1;
  return found;
}

// An entry with the same index is beside the position at which find() has ended: before key, or behind it.
bool has_index(const CO_DICT& dict, uint32_t key) {
  const CO_OBJ* const before = dict.Next;
  if (before == nullptr) {
    return false;
  }
  const CO_OBJ* const behind = before == dict.Last ? before : before + 1;
  return CO_GET_IDX(before->Key) == CO_GET_IDX(key) || CO_GET_IDX(behind->Key) == CO_GET_IDX(key);
}

}  // namespace co::dict

extern "C" CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key) {
  return cod == nullptr ? nullptr : co::dict::find(*cod, key);
}

#else

namespace co::dict {

CO_OBJ* find(CO_DICT& dict, uint32_t key) {
  const uint32_t position = first_from(dict.Root, dict.Num, CO_GET_DEV(key));
  CO_OBJ* const found = &dict.Root[position];
  return position < dict.Num && CO_GET_DEV(found->Key) == CO_GET_DEV(key) ? found : nullptr;
}

bool has_index(const CO_DICT& dict, uint32_t key) {
  const uint32_t position = first_from(dict.Root, dict.Num, CO_DEV(CO_GET_IDX(key), 0));
  return position < dict.Num && CO_GET_IDX(dict.Root[position].Key) == CO_GET_IDX(key);
}

}  // namespace co::dict

extern "C" CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key) {
  return cod == nullptr ? nullptr : co::dict::find(*cod, key);
}

#endif
