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

// Like for_each(), for one word of a set, whose lowest bit is that of number.
template <class Function>
[[gnu::always_inline]] inline void for_each_in(const uint32_t& word, unsigned number, Function function) {
  uint32_t bit = 1;
  for (uint32_t rest = word; rest != 0; rest >>= 1, bit <<= 1, ++number) {
    if ((rest & 1U) != 0 && (word & bit) != 0) {
      function(number);
    }
  }
}

// Calls function(number) for each number in the set, in ascending order; one that is removed meanwhile is left out.
template <unsigned words, class Function>
[[gnu::always_inline]] inline void for_each(const uint32_t (&set)[words], Function function) {
  for (unsigned n = 0; n != words; ++n) {
    if (words == 1 || set[n] != 0) {
      for_each_in(set[n], 32 * n, function);
    }
  }
}

// Like take_each(), for one word of a set, whose lowest bit is that of number.
template <class Function>
[[gnu::always_inline]] inline void take_each_in(uint32_t& word, unsigned number, Function function) {
  uint32_t rest = word;
  word = 0;
  for (; rest != 0; rest >>= 1, ++number) {
    if ((rest & 1U) != 0) {
      function(number);
    }
  }
}

// Empties the set, and calls function(number) for each number that was in it. Of more than 32 numbers, those that are
// removed meanwhile may be left out.
template <unsigned words, class Function>
[[gnu::always_inline]] inline void take_each(uint32_t (&set)[words], Function function) {
  for (unsigned n = 0; n != words; ++n) {
    if (words == 1 || set[n] != 0) {
      take_each_in(set[n], 32 * n, function);
    }
  }
}

}  // namespace co::bits
