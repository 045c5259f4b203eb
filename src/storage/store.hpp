// SPDX-License-Identifier: Apache-2.0
// Records in non-volatile memory. With a driver that has a Shape function (geometry of the memory) a store is atomic
// (slots.hpp); with any other driver the bytes of a record are stored unchanged at its address.
#pragma once

#include "co_core.h"

namespace co::store {

// Identity of a record. The CRC of an atomic record covers all members.
struct Record {
  uint32_t start;    // address
  uint32_t size;     // bytes of data
  uint32_t version;  // version of the layout of the data
  uint32_t group;    // sub-index of 1010h; 0: not a group of 1010h
};

// Contents of the memory at a record.
enum class Found : uint8_t {
  data,      // stored data
  defaults,  // the request to use the default values
  blank,     // nothing has ever been stored, or there is no memory
  lost,      // the record is damaged, belongs to something else, or cannot be read
  no_place,  // the record does not fit the memory
};

struct Loaded {
  Found found;
  bool is_older;  // the newest record is damaged, the one before it was loaded
};

// Returns whether stores are atomic: the driver has a Shape function.
[[nodiscard]] bool is_atomic(const CO_NODE& node);

// Returns the bytes of memory that a record of size bytes occupies; 0: there is no memory.
[[nodiscard]] uint32_t space(const CO_NODE& node, uint32_t size);

// Returns what the memory holds for a record, without copying data.
[[nodiscard]] Found find(const CO_NODE& node, const Record& record);

// Copies the first size bytes of the stored data, if there are any, to the memory of the application. The CRC of an
// atomic record is checked before; invalid data are copied only if the memory returns other bytes when it is read
// again.
[[nodiscard]] Loaded load(CO_NODE& node, const Record& record, uint8_t* to, uint32_t size);

// Stores data, unless they are stored already. Returns CO_ERR_PARA_STORE if the record does not fit into the memory,
// CO_ERR_IF_NVM_WRITE if the memory does not hold the data, CO_ERR_OBJ_STATE if the budget is used up.
[[nodiscard]] CO_ERR save(CO_NODE& node, const Record& record, const uint8_t* data);

// Stores the request to use the default values.
[[nodiscard]] CO_ERR save_defaults(CO_NODE& node, const Record& record);

}  // namespace co::store

// Functions for the records of a kind of memory: atomic slots, or bytes without header. They are those above; save()
// with null data stores the request to use the default values.
struct CO_STORE_T {
  uint32_t (*space)(const CO_NODE& node, uint32_t size);
  co::store::Found (*find)(const CO_NODE& node, const co::store::Record& record);
  co::store::Loaded (*load)(CO_NODE& node, const co::store::Record& record, uint8_t* to, uint32_t size);
  CO_ERR (*save)(CO_NODE& node, const co::store::Record& record, const uint8_t* data);
};

namespace co::store {

extern const CO_STORE_T bytes;  // linked with the adapters for classic drivers

}  // namespace co::store
