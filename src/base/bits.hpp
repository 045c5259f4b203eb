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

// Returns how many of the lowest bits of a word are skipped: whole bytes of zeros, in a large set.
template <bool is_large>
[[gnu::always_inline]] inline unsigned skipped_bits(uint32_t word) {
  unsigned bits = 0;
  for (; is_large && word != 0 && (word & UINT8_MAX) == 0; word >>= 8) {
    bits += 8;
  }
  return bits;
}

// Like for_each(), for one word of a set, whose lowest bit is that of number.
template <bool is_large, class Function>
[[gnu::always_inline]] inline void for_each_in(const uint32_t& word, unsigned number, Function function) {
  const unsigned first = skipped_bits<is_large>(word);
  uint32_t bit = uint32_t{1} << first;
  number += first;
  for (uint32_t rest = word >> first; rest != 0; rest >>= 1, bit <<= 1, ++number) {
    if ((rest & 1U) != 0 && (word & bit) != 0) {
      function(number);
    }
  }
}

// Calls function(number) for each number in the set, in ascending order; one that is removed meanwhile is left out.
template <unsigned words, class Function>
[[gnu::always_inline]] inline void for_each(const uint32_t (&set)[words], Function function) {
  for (const uint32_t& word : set) {
    for_each_in<(words > 1)>(word, static_cast<unsigned>(&word - set) * 32, function);
  }
}

// Like take_each(), for one word of a set, whose lowest bit is that of number.
template <bool is_large, class Function>
[[gnu::always_inline]] inline void take_each_in(uint32_t& word, unsigned number, Function function) {
  const unsigned first = skipped_bits<is_large>(word);
  uint32_t rest = word >> first;
  word = 0;
  number += first;
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
  for (uint32_t& word : set) {
    take_each_in<(words > 1)>(word, static_cast<unsigned>(&word - set) * 32, function);
  }
}

}  // namespace co::bits
