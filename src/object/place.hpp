// SPDX-License-Identifier: Apache-2.0
// What an entry names.
#pragma once

#include "co_obj.h"

namespace co {

// The structure that a string, a domain or another type with more than a value describes its data with.
template <class T>
[[nodiscard]] T* data_of(const CO_OBJ& obj) {
  return reinterpret_cast<T*>(uintptr_t{obj.Data});
}

}  // namespace co
