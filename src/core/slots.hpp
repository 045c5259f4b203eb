// SPDX-License-Identifier: Apache-2.0
// A record that is never torn: two slots, written in turn. Each begins with a header, which is written last and holds a
// CRC over itself and the data; the newest slot that is whole counts. Functions as in store.hpp.
#pragma once

#include "core/store.hpp"

namespace co::slots {

// Is there room for it in the memory, and does it begin on a border of its units?
[[nodiscard]] bool fits(const CO_NODE& node, const store::Record& record);

[[nodiscard]] store::Found look(const CO_NODE& node, const store::Record& record);
[[nodiscard]] store::Found load(const CO_NODE& node, const store::Record& record, uint8_t* to, uint32_t size);

// What is stored already is not written again. Success means that it was read back. data: null for the defaults.
[[nodiscard]] CO_ERR save(const CO_NODE& node, const store::Record& record, const uint8_t* data);

}  // namespace co::slots
