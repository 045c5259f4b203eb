// SPDX-License-Identifier: Apache-2.0
#include "extra/od/index.hpp"

#if USE_OD

#include "dictionary/dict.hpp"
#include "hal/port.hpp"

namespace co::od {
namespace {

static_assert(sizeof(void*) != 4 || sizeof(OD_entry_t) == 12);

uint16_t index_at(const CO_OBJ* table, unsigned position) { return CO_GET_IDX(table[position].Key); }

// Returns whether the entries are sorted by index and sub-index, without duplicates.
bool is_ascending(const CO_OBJ* table, uint16_t num) {
  uint16_t position = 1;
  while (position < num && table[position - 1].Key >> 8 < table[position].Key >> 8) {
    ++position;
  }
  return position >= num;
}

uint16_t count_objects(const CO_OBJ* table, uint16_t num) {
  uint16_t objects = num != 0 ? 1 : 0;
  for (uint16_t position = 1; position < num; ++position) {
    objects = static_cast<uint16_t>(objects + (index_at(table, position) != index_at(table, position - 1U) ? 1 : 0));
  }
  return objects;
}

// Returns the kind (ODT_…) of an object that has num entries.
uint8_t kind_of(const CO_OBJ* first, unsigned num) {
  if (num == 1 && CO_GET_SUB(first->Key) == 0) {
    return ODT_VAR;
  }
  unsigned sub = 0;
  while (sub < num && CO_GET_SUB(first[sub].Key) == sub && (sub < 2 || first[sub].Type == first[1].Type)) {
    ++sub;
  }
  return sub == num ? ODT_ARR : ODT_REC;
}

OD_entry_t* find(const OD_t& od, uint16_t index) {
  unsigned from = 0;
  unsigned to = od.size;
  while (from < to) {
    const unsigned middle = (from + to) / 2;
    if (od.list[middle].index < index) {
      from = middle + 1;
    } else {
      to = middle;
    }
  }
  return from < od.size && od.list[from].index == index ? &od.list[from] : nullptr;
}

// Moves the entries that have an extension, and whose object is still in the table, from the previous list
// (OD_t.Filled) to the front of the new list, which may be the same memory. Returns their number.
uint16_t keep_extended(const OD_t& od, OD_entry_t* list) {
  uint16_t kept = 0;
  for (const OD_entry_t* entry = od.Filled; entry != nullptr && entry->odObject != nullptr; ++entry) {
    const uint32_t position = dict::first_from(od.Table, od.TableLen, CO_DEV(entry->index, 0));
    const bool is_there = position < od.TableLen && index_at(od.Table, position) == entry->index;
    if (entry->extension != nullptr && is_there) {
      list[kept++] = *entry;
    }
  }
  return kept;
}

// Fills the list from the last object to the first, so that an entry that was moved to the front is not overwritten
// before its extension is copied.
void fill_list(OD_t& od, uint16_t objects, uint16_t kept) {
  unsigned end = od.TableLen;
  for (unsigned position = objects; position != 0; --position) {
    unsigned first = end - 1;
    while (first != 0 && index_at(od.Table, first - 1) == index_at(od.Table, first)) {
      --first;
    }
    const uint16_t index = index_at(od.Table, first);
    OD_extension_t* extension = nullptr;
    if (kept != 0 && od.list[kept - 1].index == index) {
      extension = od.list[--kept].extension;
    }
    const unsigned num = end - first;
    od.list[position - 1] = {index, static_cast<uint8_t>(num < UINT8_MAX ? num : UINT8_MAX),
                             static_cast<uint8_t>(kind_of(od.Table + first, num) | ODT_TABLE), &od, extension};
    end = first;
  }
  od.list[objects] = {};
  od.size = objects;
}

}  // namespace

CO_OBJ* find_in_table(const OD_t& od, uint32_t key) {
  const uint32_t position = dict::first_from(od.Table, od.TableLen, key);
  return position < od.TableLen && CO_GET_DEV(od.Table[position].Key) == key ? &od.Table[position] : nullptr;
}

OD_extension_t* extension_of(const CO_NODE& node, const CO_OBJ& obj) {
  const OD_entry_t* const entry = OD_find(port::od_of(node), CO_GET_IDX(obj.Key));
  return entry == nullptr ? nullptr : entry->extension;
}

}  // namespace co::od

extern "C" {

ODR_t OD_init(OD_t* od, OD_entry_t* list, uint16_t num, CO_NODE_T* node, CO_OBJ_T* table, uint16_t tableLen) {
  if (od == nullptr || list == nullptr || node == nullptr || table == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  const uint16_t entries = co::dict::count_entries(table, tableLen);
  if (!co::od::is_ascending(table, entries)) {
    return ODR_DEV_INCOMPAT;
  }
  const uint16_t objects = co::od::count_objects(table, entries);
  if (od->Node != node) {  // transfers of the same node continue
    *od = {};
  }
  od->Node = node;
  od->Table = table;
  od->TableLen = entries;
  if (num <= objects) {
    od->size = objects;
    od->list = nullptr;
    return ODR_OUT_OF_MEM;
  }
  const uint16_t kept = co::od::keep_extended(*od, list);
  od->list = list;
  od->Filled = list;
  co::od::fill_list(*od, objects, kept);
  return ODR_OK;
}

OD_entry_t* OD_find(OD_t* od, uint16_t index) {
  return od == nullptr || od->list == nullptr ? nullptr : co::od::find(*od, index);
}

uint16_t OD_getIndex(const OD_entry_t* entry) { return entry == nullptr ? static_cast<uint16_t>(0) : entry->index; }

}  // extern "C"

#endif
