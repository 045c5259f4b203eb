// SPDX-License-Identifier: Apache-2.0
// Kind and memory of a dictionary entry, by its original type.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

inline constexpr uint32_t longest_number = 8;  // bytes

// Kind of an entry.
enum class Kind : uint8_t {
  number,              // a value of up to 8 bytes
  long_value,          // a longer value, read or written in one call
  text,                // a CO_OBJ_STR_RW that ends at its first zero
  octets,              // a CO_OBJ_STR_RW
  constant_text,       // a CO_OBJ_STR
  domain,              // a CO_OBJ_DOM
  application_stream,  // a stream whose type the application defines: only its functions access the data
  none                 // no original type: only an extension can access it
};

// Properties of an entry.
struct Properties {
  Kind kind;
  const CO_OBJ_TYPE* type;  // original type; null: none
  void* memory;             // value of the entry; null: none, or only the type has its address
  OD_size_t length;         // bytes, for OD_stream_t.dataLength; 0: not known
  OD_attr_t attribute;      // bits ODA_…, for OD_stream_t.attribute
};

#if USE_OD

[[nodiscard]] inline bool is_extensible(const CO_OBJ_TYPE& type) { return type.Init == ODTypeInit; }

// Returns the OD_TYPE of an entry; null: the entry cannot be extended.
[[nodiscard]] inline const OD_TYPE* extensible(const CO_OBJ& obj) {
  return is_extensible(*obj.Type) ? reinterpret_cast<const OD_TYPE*>(obj.Type) : nullptr;
}

// Returns the original type of an entry; null: it has none.
[[nodiscard]] inline const CO_OBJ_TYPE* original_type(const CO_OBJ& obj) {
  const OD_TYPE* const type = extensible(obj);
  return type == nullptr ? obj.Type : type->Original;
}

// Returns an original type as CO_OBJ_TYPE_EX; null if it is no such type.
[[nodiscard]] inline const CO_OBJ_TYPE_EX* extended_type(const CO_OBJ_TYPE* type) {
  return type != nullptr && type->Reset == COObjTypeExReset ? reinterpret_cast<const CO_OBJ_TYPE_EX*>(type) : nullptr;
}
// can_seek() returns whether an original type can set a position, seek() sets it. For a CO_OBJ_TYPE_EX both use its own
// Reset function: COObjTypeExReset() would use the type of the entry, which is the OD_TYPE.
[[nodiscard]] bool can_seek(const CO_OBJ_TYPE& type);
[[nodiscard]] CO_ERR seek(CO_OBJ& obj, CO_NODE& node, const CO_OBJ_TYPE& type, uint32_t position);

// Returns the bytes of a character of a string, by its original type; 1 for all other types.
[[nodiscard]] unsigned bytes_of_character(const CO_OBJ_TYPE* original);

[[nodiscard]] Properties properties_of(CO_OBJ& obj, CO_NODE& node);

// Returns a stream for an access to the entry, at its beginning.
[[nodiscard]] OD_stream_t stream_of(CO_OBJ& obj, CO_NODE& node);

#endif

}  // namespace co::od
