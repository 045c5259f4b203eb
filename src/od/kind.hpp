// SPDX-License-Identifier: Apache-2.0
// What an entry is by its original type.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

enum class Kind : uint8_t {
  number,         // a value of up to 8 bytes
  long_value,     // a longer one, which passes in one call
  text,           // a CO_OBJ_STR_RW that ends at its first zero
  octets,         // a CO_OBJ_STR_RW
  constant_text,  // a CO_OBJ_STR
  domain,         // a CO_OBJ_DOM
  foreign,        // a stream of the application
  none            // only an extension has it
};

// An entry, seen through.
struct Shape {
  Kind kind;
  const CO_OBJ_TYPE* type;  // original; null: none
  void* memory;             // null: none, or only the type knows
  OD_size_t length;         // as OD_stream_t.dataLength
  OD_attr_t attribute;
};

#if USE_OD

[[nodiscard]] inline bool is_extensible(const CO_OBJ_TYPE& type) { return type.Init == ODTypeInit; }

// The type that lets the entry be extended; null: it cannot be.
[[nodiscard]] inline const OD_TYPE* extensible(const CO_OBJ& obj) {
  return is_extensible(*obj.Type) ? reinterpret_cast<const OD_TYPE*>(obj.Type) : nullptr;
}

[[nodiscard]] inline const CO_OBJ_TYPE* original_type(const CO_OBJ& obj) {
  const OD_TYPE* const type = extensible(obj);
  return type == nullptr ? obj.Type : type->Original;
}

// Original types are called with the entry as it is. One that takes part in transfers has its own Reset function behind
// COObjTypeExReset(), which would look at the type of the entry.
[[nodiscard]] inline const CO_OBJ_TYPE_EX* transfer_type(const CO_OBJ_TYPE* type) {
  return type != nullptr && type->Reset == COObjTypeExReset ? reinterpret_cast<const CO_OBJ_TYPE_EX*>(type) : nullptr;
}
[[nodiscard]] bool can_seek(const CO_OBJ_TYPE& type);
[[nodiscard]] CO_ERR seek(CO_OBJ& obj, CO_NODE& node, const CO_OBJ_TYPE& type, uint32_t position);

// Of a string; null: only an extension has it.
[[nodiscard]] unsigned bytes_of_character(const CO_OBJ_TYPE* original);

[[nodiscard]] Shape shape_of(CO_OBJ& obj, CO_NODE& node);

// An access to it that begins.
[[nodiscard]] OD_stream_t stream_of(CO_OBJ& obj, CO_NODE& node);

#endif

}  // namespace co::od
