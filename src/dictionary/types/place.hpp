// SPDX-License-Identifier: Apache-2.0
// Data of a dictionary entry.
#pragma once

#include "co_obj.h"

namespace co {

// Returns Data of an entry as a pointer: to its variable, or to the structure that describes a string, a domain or
// another object that is more than a value.
template <class T>
[[nodiscard]] T* data_of(const CO_OBJ& obj) {
  return reinterpret_cast<T*>(uintptr_t{obj.Data});
}

}  // namespace co
