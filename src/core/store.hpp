// SPDX-License-Identifier: Apache-2.0
// Records in non-volatile memory. With a driver that tells the shape of the memory they are never torn (slots.hpp);
// with any other the bytes lie as they are at the address that the record names.
#pragma once

#include "co_core.h"

namespace co::store {

struct Record {
  uint32_t start;    // address
  uint32_t size;     // bytes of data
  uint32_t version;  // of their layout: others are foreign
};

enum class Found : uint8_t {
  data,      // they were stored
  defaults,  // these were asked for
  blank,     // nothing has ever been stored, or there is no memory
  lost,      // what is there is damaged, foreign, or cannot be read
  no_place,  // the record does not fit the memory
};

// Does the driver tell its shape?
[[nodiscard]] bool is_never_torn(const CO_NODE& node);

// What there is.
[[nodiscard]] Found look(const CO_NODE& node, const Record& record);

// The same, and copies the first size bytes of the data if this is the answer. All data have been checked before, if
// they can be: nothing is copied else, unless the memory cannot be read twice.
[[nodiscard]] Found load(const CO_NODE& node, const Record& record, uint8_t* to, uint32_t size);

// Stores data; CO_ERR_PARA_STORE: no place, CO_ERR_IF_NVM_WRITE: the memory does not hold them.
[[nodiscard]] CO_ERR save(const CO_NODE& node, const Record& record, const uint8_t* data);

// Stores that the defaults are to be used.
[[nodiscard]] CO_ERR save_defaults(const CO_NODE& node, const Record& record);

}  // namespace co::store
