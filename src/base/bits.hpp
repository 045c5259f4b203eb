// SPDX-License-Identifier: Apache-2.0
// Sets of small numbers, such as those of PDOs: one bit for each.
#pragma once

#include <stdint.h>

namespace co::bits {

template <unsigned words>
void add(uint32_t (&set)[words], unsigned number) {
  set[words == 1 ? 0 : number / 32] |= uint32_t{1} << (words == 1 ? number : number % 32);
}

template <unsigned words>
void remove(uint32_t (&set)[words], unsigned number) {
  set[words == 1 ? 0 : number / 32] &= ~(uint32_t{1} << (words == 1 ? number : number % 32));
}

template <unsigned words>
bool is_empty(const uint32_t (&set)[words]) {
  uint32_t all = 0;
  for (const uint32_t word : set) {
    all |= word;
  }
  return all == 0;
}

// Returns the lowest number in the set that is not below from, or end if there is none.
template <unsigned words>
unsigned next(const uint32_t (&set)[words], unsigned from, unsigned end) {
  while (from < end) {
    const uint32_t rest = words == 1 ? set[0] >> from : set[from / 32] >> from % 32;
    if ((rest & 1U) != 0) {
      return from;
    }
    from = words == 1 || rest != 0 ? from + 1 : (from | 31U) + 1;
  }
  return end;
}

}  // namespace co::bits
