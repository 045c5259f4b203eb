// SPDX-License-Identifier: Apache-2.0
/// \file mask_filters.hpp
/// Acceptance filters of a word and a mask, which are merged, for controllers that have fewer filters than the node has
/// identifiers.
#ifndef CO_DRIVERS_MASK_FILTERS_HPP_
#define CO_DRIVERS_MASK_FILTERS_HPP_

#include <cstdint>

#include "transmit.hpp"

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

/// Filters for identifiers as words.
namespace co::identifiers {
/// \cond internal

using mask_filters::Filters;

/// Bit of a word: 29-bit identifier. It is always compared. Bits 0…28 are the identifier; that of 11 bits is in bits
/// 18…28.
inline constexpr std::uint32_t extended_bit = std::uint32_t{1} << 29;
inline constexpr std::uint32_t standard_mask = extended_bit | (std::uint32_t{0x7FF} << 18);
inline constexpr std::uint32_t all_bits = extended_bit | 0x1FFFFFFF;

using Item = mask_filters::Filter<std::uint32_t>;

/// Returns the word of an identifier, which is coded like in CO_IF_FRM.
inline std::uint32_t word_of(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return transmit::is_extended(identifier) ? id | extended_bit : id << 18;
}

/// Returns the number of 11-bit identifiers, or of groups of 2^15 29-bit identifiers, that pass a filter.
inline std::int32_t width(const Item& item) {
  constexpr unsigned bits_of_group = 15;
  const bool is_extended = (item.word & extended_bit) != 0;
  const unsigned open = mask_filters::count_bits((is_extended ? all_bits : standard_mask) & ~item.mask);
  const unsigned ignored = is_extended ? bits_of_group : 0;
  return std::int32_t{1} << (open > ignored ? open - ignored : 0);
}

/// Returns the width that merging adds; INT32_MAX for identifiers of different length.
inline std::int32_t added_by_merging(const Item& a, const Item& b) {
  const bool is_same_kind = ((a.word ^ b.word) & extended_bit) == 0;
  return is_same_kind ? width(mask_filters::both(a, b)) - width(a) - width(b) : INT32_MAX;
}

/// Returns at most \a most filters that pass identifiers, which are coded like in CO_IF_CAN_DRV_EX.Filter, ascending.
template <unsigned most>
Filters<std::uint32_t, most> items_of(const std::uint32_t* ids, unsigned num) {
  Filters<std::uint32_t, most> items = {};
  for (unsigned n = 0; n < num; ++n) {
    const Item item = {word_of(ids[n]), transmit::is_extended(ids[n]) ? all_bits : standard_mask};
    if (mask_filters::passes(items, item)) {
      continue;
    }
    items.filter[items.number++] = item;
    if (items.number > most) {
      mask_filters::merge_two(items, added_by_merging);
    }
  }
  return items;
}

/// \endcond
}  // namespace co::identifiers

#endif
