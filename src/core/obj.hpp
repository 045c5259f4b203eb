// SPDX-License-Identifier: Apache-2.0
// Access to one entry through its type.
#pragma once

#include "co_obj.h"

namespace co::obj {

// A stream of bytes has a position that Reset() sets; anything else is a value.
[[nodiscard]] inline bool is_stream(const CO_OBJ& obj) { return obj.Type->Reset != nullptr; }

[[nodiscard]] uint32_t size(CO_OBJ& obj, CO_NODE_T& node, uint32_t width);
[[nodiscard]] CO_ERR read(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size);
[[nodiscard]] CO_ERR write(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size);
[[nodiscard]] CO_ERR seek(CO_OBJ& obj, CO_NODE_T& node, uint32_t position);

// For types that take part in the whole transfer; others see nothing.
[[nodiscard]] inline const CO_OBJ_TYPE_EX* extended(const CO_OBJ& obj) {
  const bool is_extended = obj.Type->Reset == COObjTypeExReset;
  return is_extended ? reinterpret_cast<const CO_OBJ_TYPE_EX*>(obj.Type) : nullptr;
}
// Can the position be set?
[[nodiscard]] inline bool can_seek(const CO_OBJ& obj) {
  const CO_OBJ_TYPE_EX* const type = extended(obj);
  return type == nullptr ? is_stream(obj) : type->Reset != nullptr;
}
[[nodiscard]] CO_ERR begin(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, uint32_t size);
[[nodiscard]] CO_ERR end(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, uint32_t abort);

}  // namespace co::obj
