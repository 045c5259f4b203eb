// SPDX-License-Identifier: Apache-2.0
// Where an entry keeps its value: in the variable that it names, or in itself (flag D).
#pragma once

#include "co_obj.h"

namespace co {

[[nodiscard]] inline void* place_of(CO_OBJ& obj) {
  return CO_IS_DIRECT(obj.Key) != 0 ? static_cast<void*>(&obj.Data) : reinterpret_cast<void*>(uintptr_t{obj.Data});
}

// The structure that a string, a domain or another type with more than a value describes its data with.
template <class T>
[[nodiscard]] T* data_of(const CO_OBJ& obj) {
  return reinterpret_cast<T*>(uintptr_t{obj.Data});
}

}  // namespace co
