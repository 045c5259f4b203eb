// SPDX-License-Identifier: Apache-2.0
/// \file mask_filters.hpp
/// Merges acceptance filters of a word and a mask, for controllers that have fewer filters than the node has
/// identifiers.
#ifndef CO_DRIVERS_MASK_FILTERS_HPP_
#define CO_DRIVERS_MASK_FILTERS_HPP_

#include <cstdint>

namespace co::mask_filters {
/// \cond internal

/// Filter that passes the words that are equal to \a word in all bits of \a mask. The other bits of \a word are 0.
template <typename Word>
struct Filter {
  Word word;
  Word mask;
};

template <typename Word, unsigned most>
struct Filters {
  Filter<Word> filter[most + 1];  // the last one is used only during the computation
  unsigned number;
};

/// Returns the narrowest filter that passes what either filter passes.
template <typename Word>
Filter<Word> both(const Filter<Word>& a, const Filter<Word>& b) {
  const auto mask = static_cast<Word>(a.mask & b.mask & ~(a.word ^ b.word));
  return {static_cast<Word>(a.word & mask), mask};
}

/// Returns the number of bits that are set.
inline unsigned count_bits(std::uint32_t bits) {
  unsigned number = 0;
  for (; bits != 0; bits &= bits - 1) {
    ++number;
  }
  return number;
}

/// Returns whether a filter passes all that another one passes.
template <typename Word>
bool includes(const Filter<Word>& filter, const Filter<Word>& other) {
  return (filter.mask & ~other.mask) == 0 && ((filter.word ^ other.word) & filter.mask) == 0;
}

/// Returns whether one of the filters passes all that \a filter passes.
template <typename Word, unsigned most>
bool passes(const Filters<Word, most>& all, const Filter<Word>& filter) {
  for (unsigned n = 0; n < all.number; ++n) {
    if (includes(all.filter[n], filter)) {
      return true;
    }
  }
  return false;
}

/// Merges the two neighbouring filters for which \a added returns the least: the number of other identifiers that pass
/// the merged filter.
template <typename Word, unsigned most, typename Added>
void merge_two(Filters<Word, most>& all, Added added) {
  unsigned best = 0;
  std::int32_t least = INT32_MAX;
  for (unsigned n = 0; n + 1 < all.number; ++n) {
    const std::int32_t others = added(all.filter[n], all.filter[n + 1]);
    if (others < least) {
      least = others;
      best = n;
    }
  }
  all.filter[best] = both(all.filter[best], all.filter[best + 1]);
  --all.number;
  for (unsigned n = best + 1; n < all.number; ++n) {
    all.filter[n] = all.filter[n + 1];
  }
}

/// \endcond
}  // namespace co::mask_filters

#endif
