// SPDX-License-Identifier: Apache-2.0
// Lists of texts in one array of characters: no pointers, so that no relocation is needed.
#pragma once

#include <stdint.h>

namespace co::texts {

// Returns the text with a number, from 0, of a list in which each text ends with a NUL, and the list with one more;
// otherwise: the list is shorter.
[[nodiscard]] inline const char* find(const char* list, uint32_t number, const char* otherwise) {
  for (; *list != '\0' && number != 0; --number) {
    while (*list != '\0') {
      ++list;
    }
    ++list;
  }
  return *list != '\0' ? list : otherwise;
}

}  // namespace co::texts
