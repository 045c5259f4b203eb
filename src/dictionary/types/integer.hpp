// SPDX-License-Identifier: Apache-2.0
// Access to the numbers that type functions get: in the byte order of the CPU, at any alignment.
#pragma once

#include <stdint.h>

#include "co_obj.h"

namespace co::integer {

[[nodiscard]] uint16_t get_u16(const void* from);
[[nodiscard]] uint32_t get_u32(const void* from);
void put_u32(void* to, uint32_t value);

// Functions of a type with a value of 1, 2 or 4 bytes, in a variable of the same size: for the tables of other types.
template <uint8_t bytes>
struct Number {
  static uint32_t size(CO_OBJ* obj, CO_NODE_T* node, uint32_t width);
  static CO_ERR read(CO_OBJ* obj, CO_NODE_T* node, void* buffer, uint32_t size);
  static CO_ERR write(CO_OBJ* obj, CO_NODE_T* node, void* buffer, uint32_t size);
};
extern template struct Number<1>;
extern template struct Number<2>;
extern template struct Number<4>;

}  // namespace co::integer
