// SPDX-License-Identifier: Apache-2.0
// An atomic record: two slots, written alternately. Each begins with a header, which is written last and holds a CRC
// over itself, the identity of the record and the data; the newest slot whose CRC fits counts. Functions as in
// store.hpp.
#pragma once

#include "core/store.hpp"

namespace co::slots {

// Returns the bytes that both slots occupy.
[[nodiscard]] uint32_t space(const CO_NODE& node, uint32_t size);

// Returns whether the record fits into the memory and begins at a multiple of its units.
[[nodiscard]] bool fits(const CO_NODE& node, const store::Record& record);

[[nodiscard]] store::Found look(const CO_NODE& node, const store::Record& record);
[[nodiscard]] store::Loaded load(CO_NODE& node, const store::Record& record, uint8_t* to, uint32_t size);

// Data that are stored already are not written again. Success means that they were read back. data: null for the
// defaults.
[[nodiscard]] CO_ERR save(CO_NODE& node, const store::Record& record, const uint8_t* data);

// Compares bytes.
[[nodiscard]] bool is_same(const uint8_t* a, const uint8_t* b, uint32_t num);

}  // namespace co::slots
