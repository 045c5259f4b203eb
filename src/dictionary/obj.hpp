// SPDX-License-Identifier: Apache-2.0
// Access to one dictionary entry through its type.
#pragma once

#include "co_cfg.h"
#include "co_obj.h"
#include "wire/abort.hpp"

namespace co {

// Returns Data of an entry as a pointer: to its variable, or to the structure that describes a string, a domain or
// another object that is more than a value.
template <class T>
[[nodiscard]] T* data_of(const CO_OBJ& obj) {
  return reinterpret_cast<T*>(uintptr_t{obj.Data});
}

}  // namespace co

namespace co::obj {

// Returns whether the object is a stream of bytes, which has a position that Reset() sets; any other object is a value.
[[nodiscard]] inline bool is_stream(const CO_OBJ& obj) { return obj.Type->Reset != nullptr; }

[[nodiscard]] inline uint32_t size(CO_OBJ& obj, CO_NODE_T& node, uint32_t width) {
  return obj.Type->Size == nullptr ? 0 : obj.Type->Size(&obj, &node, width);
}
[[nodiscard]] inline CO_ERR read(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size) {
  return obj.Type->Read == nullptr ? CO_ERR_OBJ_ACC : obj.Type->Read(&obj, &node, buffer, size);
}
[[nodiscard]] inline CO_ERR write(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size) {
  return obj.Type->Write == nullptr ? CO_ERR_OBJ_ACC : obj.Type->Write(&obj, &node, buffer, size);
}
// Like write(), for API functions: a node without drivers is refused.
[[nodiscard]] CO_ERR write_for_application(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size);
// Sets the position of a stream; no effect on a value.
[[nodiscard]] inline CO_ERR seek(CO_OBJ& obj, CO_NODE_T& node, uint32_t position) {
  return obj.Type->Reset == nullptr ? CO_ERR_NONE : obj.Type->Reset(&obj, &node, position);
}

// Returns the extended type of an object, whose functions are called at the begin and end of a transfer; null if the
// type is not a CO_OBJ_TYPE_EX.
[[nodiscard]] inline const CO_OBJ_TYPE_EX* extended([[maybe_unused]] const CO_OBJ& obj) {
#if USE_OBJ_EX
  if (obj.Type->Reset == COObjTypeExReset) {
    return reinterpret_cast<const CO_OBJ_TYPE_EX*>(obj.Type);
  }
#endif
  return nullptr;
}
// Returns whether size means that the length of the object is not known yet.
[[nodiscard]] constexpr bool is_unknown(uint32_t size) { return USE_OBJ_EX != 0 && size == CO_OBJ_SIZE_UNKNOWN; }
// Returns whether size is no valid length of an upload. An empty stream has a valid length, 0.
[[nodiscard]] inline bool is_no_size(const CO_OBJ& obj, uint32_t size) {
  return (size == 0 && !is_stream(obj)) || (USE_OBJ_EX == 0 && size == CO_OBJ_SIZE_UNKNOWN);
}
// Returns whether the position of the object can be set.
[[nodiscard]] inline bool can_seek(const CO_OBJ& obj) {
  const CO_OBJ_TYPE_EX* const type = extended(obj);
  return type == nullptr ? is_stream(obj) : type->Reset != nullptr;
}
[[nodiscard]] CO_ERR begin(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, uint32_t size);
[[nodiscard]] CO_ERR end(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, Abort abort);

}  // namespace co::obj
