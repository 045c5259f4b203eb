// SPDX-License-Identifier: Apache-2.0
// Object scanner list and object dispatching list. [301:7.5.2.39-40]
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "service/mpdo/mpdo.hpp"
#include "wire/mpdo.hpp"

#if CO_MPDO_N > 0

namespace co::mpdo {
namespace {

// Returns the first error, but a lack of space (CO_ERR_OBJ_MAP_LEN) has priority.
CO_ERR worse_of(CO_ERR err, CO_ERR next) { return err == CO_ERR_NONE || next == CO_ERR_OBJ_MAP_LEN ? next : err; }

// Adds the entries of a list that are not 0, with indices first…last, in the order of the dictionary.
template <class T>
CO_ERR resolve_entries(CO_NODE& node, uint16_t first, uint16_t last, CO_ERR (*add)(CO_NODE&, T)) {
  const CO_OBJ* const begin = dict::find(node, CO_DEV(first, 1));
  if (begin == nullptr) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  CO_ERR result = CO_ERR_NONE;
  for (auto n = static_cast<uint16_t>(begin - node.Dict.Root); n < node.Dict.Num; ++n) {
    CO_OBJ& obj = node.Dict.Root[n];
    T entry = 0;
    if (CO_GET_IDX(obj.Key) > last) {
      break;
    }
    if (CO_GET_SUB(obj.Key) == 0) {
      continue;
    }
    result = worse_of(result, obj::read(obj, node, &entry, sizeof entry));
    result = entry == 0 ? result : worse_of(result, add(node, entry));
  }
  return result;
}

// Checks the objects of a block, which have consecutive sub-indices.
CO_ERR check_block(CO_NODE& node, Direction direction, uint32_t key, uint8_t num) {
  if (CO_GET_SUB(key) + num > UINT8_MAX + 1) {
    return CO_ERR_OBJ_RANGE;
  }
  CO_ERR err = CO_ERR_NONE;
  for (uint8_t n = 0; n < num && err == CO_ERR_NONE; ++n, key += wire::mpdo_next_sub) {
    err = check_object(node, direction, dict::find(node, key), key);
  }
  return err;
}

// Returns the number of the entry with the key. It exists: check_block() has found it.
uint16_t entry_of(CO_NODE& node, uint32_t key) {
  const CO_OBJ* const obj = dict::find(node, key);
  CO_ASSERT(obj != nullptr);
  return static_cast<uint16_t>(obj - node.Dict.Root);
}

// Scanner list --------------------------------------------------------------------------------------------------------

CO_ERR check(CO_NODE& node, uint32_t entry) {
  return check_block(node, Direction::transmit, wire::scan_key(entry), wire::mpdo_block(entry));
}

CO_ERR add(CO_NODE& node, uint32_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  const CO_ERR err = check(node, entry);
  const uint8_t num = wire::mpdo_block(entry);
  if (err != CO_ERR_NONE) {
    return err;
  }
  if (num > CO_MPDO_N - mpdo.ScanNum) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  uint16_t first = entry_of(node, wire::scan_key(entry));
  for (const unsigned end = mpdo.ScanNum + num; mpdo.ScanNum < end; ++first) {
    mpdo.Scan[mpdo.ScanNum++] = first;
  }
  return CO_ERR_NONE;
}

// Dispatching list ----------------------------------------------------------------------------------------------------

CO_ERR check(CO_NODE& node, uint64_t entry) {
  const uint32_t producer = wire::dispatch_producer(entry);
  const uint32_t own = wire::dispatch_own(entry);
  const uint32_t node_id = producer & 0xFFU;
  if (node_id == 0 || node_id > wire::mpdo_node_id || CO_GET_SUB(producer) + wire::mpdo_block(own) > UINT8_MAX + 1) {
    return CO_ERR_OBJ_RANGE;
  }
  return check_block(node, Direction::receive, wire::dispatch_key(entry), wire::mpdo_block(own));
}

CO_ERR add(CO_NODE& node, uint64_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  const CO_ERR err = check(node, entry);
  if (err != CO_ERR_NONE) {
    return err;
  }
  if (mpdo.BlockNum == CO_MPDO_N) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  mpdo.Block[mpdo.BlockNum++] = {wire::dispatch_producer(entry), entry_of(node, wire::dispatch_key(entry)),
                                 wire::mpdo_block(wire::dispatch_own(entry))};
  return CO_ERR_NONE;
}

// Object types --------------------------------------------------------------------------------------------------------

template <const CO_OBJ_TYPE& number>
uint32_t size_entry(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  return number.Size(obj, node, width);
}

template <const CO_OBJ_TYPE& number>
CO_ERR read_entry(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return number.Read(obj, node, buffer, size);
}

// Restores the previous entry if the new one does not fit into the node's memory.
template <class T, const CO_OBJ_TYPE& number, CO_ERR (*resolve)(CO_NODE&)>
CO_ERR write_entry(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  T before = 0;
  T value = 0;
  if (size != sizeof value || number.Read(obj, node, &before, size) != CO_ERR_NONE) {
    return CO_ERR_BAD_ARG;
  }
  __builtin_memcpy(&value, buffer, sizeof value);
  CO_ERR err = value == 0 ? CO_ERR_NONE : check(*node, value);
  if (err == CO_ERR_NONE) {
    err = number.Write(obj, node, buffer, size);
  }
  if (err == CO_ERR_NONE && value != before && resolve(*node) == CO_ERR_OBJ_MAP_LEN) {
    (void)number.Write(obj, node, &before, size);
    (void)resolve(*node);
    err = CO_ERR_OBJ_MAP_LEN;
  }
  return err;
}

}  // namespace

CO_ERR resolve_scan(CO_NODE& node) {
  CO_MPDO& mpdo = node.Mpdo;
  mpdo.ScanNum = 0;
  mpdo.NextObject = 0;
  clear_marks(node);
  __builtin_memset(mpdo.Transferred, 0, sizeof mpdo.Transferred);
  return resolve_entries<uint32_t>(node, 0x1FA0, 0x1FCF, add);
}

CO_ERR resolve_dispatch(CO_NODE& node) {
  node.Mpdo.BlockNum = 0;
  return resolve_entries<uint64_t>(node, 0x1FD0, 0x1FFF, add);
}

}  // namespace co::mpdo

extern "C" {

const CO_OBJ_TYPE COTPdoScan = {co::mpdo::size_entry<COTInt32>, co::dict::checked_by<co::rules::pdo_scan>,
                                co::mpdo::read_entry<COTInt32>,
                                co::mpdo::write_entry<uint32_t, COTInt32, co::mpdo::resolve_scan>, nullptr};
const CO_OBJ_TYPE COTPdoDispatch = {co::mpdo::size_entry<COTInt64>, co::dict::checked_by<co::rules::pdo_dispatch>,
                                    co::mpdo::read_entry<COTInt64>,
                                    co::mpdo::write_entry<uint64_t, COTInt64, co::mpdo::resolve_dispatch>, nullptr};

}  // extern "C"

#endif
