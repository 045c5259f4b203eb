// SPDX-License-Identifier: Apache-2.0
// Lists of texts, each in one array of characters: an array of pointers would need relocations.
#pragma once

#include <stdint.h>

namespace co::texts {

// Returns the text with a number, from 0, of a list; otherwise if the list is shorter. Each text ends with a NUL, and
// the list with a second NUL.
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
