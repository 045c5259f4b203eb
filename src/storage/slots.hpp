// SPDX-License-Identifier: Apache-2.0
// Atomic (power-fail safe) record: two slots, written alternately. Each begins with a header, which is written last and
// holds a CRC over the header, the identity of the record and the data; the newest slot with a valid CRC is used.
// Functions of the same name do what those of store.hpp do.
#pragma once

#include "storage/store.hpp"

namespace co::slots {

// Returns the bytes of memory that both slots of a record of size bytes occupy.
[[nodiscard]] uint32_t space(const CO_NODE& node, uint32_t size);

// Returns whether the record fits into the memory and begins at a multiple of its erase size, or of its program size if
// it has no erase size.
[[nodiscard]] bool fits(const CO_NODE& node, const store::Record& record);

[[nodiscard]] store::Found find(const CO_NODE& node, const store::Record& record);
[[nodiscard]] store::Loaded load(CO_NODE& node, const store::Record& record, uint8_t* to, uint32_t size);

// Stores data, unless they are stored already, and reads them back: CO_ERR_NONE means that they were found in the
// memory. data: null to store that the defaults are to be used. Nothing is written if the slot that held the newest
// record, when the record was loaded or saved last, cannot be read now (CO_ERR_IF_NVM_WRITE).
[[nodiscard]] CO_ERR save(CO_NODE& node, const store::Record& record, const uint8_t* data);

// Returns whether num bytes are equal.
[[nodiscard]] bool is_same(const uint8_t* a, const uint8_t* b, uint32_t num);

extern const CO_STORE_T store;

}  // namespace co::slots
