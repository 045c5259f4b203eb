// SPDX-License-Identifier: Apache-2.0
// Access to the numbers that type functions get: in the byte order of the CPU, at any alignment.
#pragma once

#include <stdint.h>
#include "co_obj.h"

namespace co::integer {

[[nodiscard]] uint32_t get_u32(const void* from);
void put_u32(void* to, uint32_t value);

// Format of a number: its width in bytes, or cob_id for an UNSIGNED32 that has flags above a CAN-ID. With flag N only
// the CAN-ID is relative to the node-ID; any other number is relative as a whole.
inline constexpr uint8_t cob_id = 12;

// Returns the width of a format in bytes.
constexpr unsigned bytes_of(unsigned format) { return format & 7U; }

// Functions of a type with a value of 1, 2 or 4 bytes, in a variable of the same size: for the tables of other types.
template <uint8_t format>
struct Number {
  static uint32_t size(CO_OBJ* obj, CO_NODE_T* node, uint32_t width);
  static CO_ERR read(CO_OBJ* obj, CO_NODE_T* node, void* buffer, uint32_t size);
  static CO_ERR write(CO_OBJ* obj, CO_NODE_T* node, void* buffer, uint32_t size);
};
extern template struct Number<1>;
extern template struct Number<2>;
extern template struct Number<4>;
extern template struct Number<cob_id>;

}  // namespace co::integer

// Rules for the values of objects that hold a COB-ID.

namespace co::cob_id {

// Returns the identifier of frames with this COB-ID, wire::no_frame if there can be none (wire::is_usable()).
[[nodiscard]] uint32_t identifier(uint32_t cob_id);

// Returns whether a configurable object may have this CAN-ID, in the frame format that bit 29 selects. [301:7.3.5]
[[nodiscard]] bool is_free(uint32_t cob_id);

// Returns whether most objects permit a value: one with bit 31 set (not valid) may always be written; a valid COB-ID
// only if it is unchanged, or if the COB-ID before is not valid and is_free() permits the CAN-ID.
[[nodiscard]] bool may_replace(uint32_t before, uint32_t value);

}  // namespace co::cob_id
