// SPDX-License-Identifier: Apache-2.0
// Atomic (power-fail safe) record: two slots, written alternately. Each begins with a header, which is written last and
// holds a CRC over the header, the identity of the record and the data; the newest slot with a valid CRC is used.
#pragma once

#include "storage/store.hpp"

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
