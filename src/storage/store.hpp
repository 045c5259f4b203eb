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
  no_room,   // the record does not fit the memory
};

// Memory of the application that a record is loaded to.
struct Target {
  uint8_t* to;
  uint32_t size;  // bytes to load: the first ones of the record
  bool is_older;  // result: the newest record is damaged, the one before it was loaded
};

// Returns the bytes of memory that a record occupies; 0: there is no memory.
[[nodiscard]] uint32_t space(CO_NODE& node, const Record& record);

// Reason of a store.
enum class Cause : uint8_t {
  command,  // a command
  change,   // a change that is stored autonomously: not stored while the memory holds the request to use the defaults
};

}  // namespace co::store

// Functions for the records of a kind of memory: atomic slots, or bytes without header.
struct CO_STORE_T {
  // Copies the first bytes of the stored data, if there are any, to the memory of the application. The CRC of an atomic
  // record is checked before; invalid data are copied only if the memory returns other bytes when it is read again.
  co::store::Found (*load)(CO_NODE& node, const co::store::Record& record, co::store::Target& target);

  // Stores data, unless they are stored already. Null data: stores the request to use the default values. Returns
  // CO_ERR_PARA_STORE if the record does not fit into the memory, CO_ERR_IF_NVM_WRITE if the memory does not hold the
  // data, CO_ERR_OBJ_STATE if the budget is used up.
  CO_ERR (*save)(CO_NODE& node, const co::store::Record& record, const uint8_t* data, co::store::Cause cause);
};

namespace co::store {

extern const CO_STORE_T bytes;  // linked with the adapters for classic drivers

// Returns the functions for the node's memory.
[[nodiscard]] const CO_STORE_T& of(const CO_NODE& node);

}  // namespace co::store

// Atomic (power-fail safe) record: two slots, written alternately. Each begins with a header, which is written last and
// holds a CRC over the header, the identity of the record and the data; the newest slot with a valid CRC is used.
namespace co::slots {

// Returns whether num bytes are equal.
[[nodiscard]] bool is_same(const uint8_t* a, const uint8_t* b, uint32_t num);

// Functions of store.hpp for a memory with Shape function. A store is read back: CO_ERR_NONE means that the data were
// found in the memory. Nothing is written if the slot that held the newest record, when the record was loaded or saved
// last, cannot be read now (CO_ERR_IF_NVM_WRITE).
extern const CO_STORE_T store;

// Returns the bytes of memory that a record occupies.
[[nodiscard]] uint32_t space(CO_NODE& node, const store::Record& record);

}  // namespace co::slots
