// SPDX-License-Identifier: Apache-2.0
#include "bxcan_filters.hpp"

#include "../transmit.hpp"
#include "bxcan_registers.h"

namespace co::bxcan {
namespace {

// Bits that distinguish identifiers. RTR is not among them: remote frames pass like data frames.
constexpr std::uint16_t standard_bits = (0x7FF << CO_BXCAN_FILTER_STID_SHIFT) | CO_BXCAN_FILTER_IDE;
constexpr std::uint16_t extended_bits = standard_bits | CO_BXCAN_FILTER_EXID;

Filter exactly(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  if (!transmit::is_extended(identifier)) {
    return {static_cast<std::uint16_t>(id << CO_BXCAN_FILTER_STID_SHIFT), standard_bits};
  }
  const std::uint32_t word = ((id >> 18) << CO_BXCAN_FILTER_STID_SHIFT) | CO_BXCAN_FILTER_IDE | ((id >> 15) & 7);
  return {static_cast<std::uint16_t>(word), extended_bits};
}

Filter both(const Filter& a, const Filter& b) {
  const auto mask = static_cast<std::uint16_t>(a.mask & b.mask & ~(a.word ^ b.word));
  return {static_cast<std::uint16_t>(a.word & mask), mask};
}

// Returns the number of combinations of the compared bits that pass a filter.
std::int32_t width(const Filter& filter) {
  std::int32_t words = 1;
  for (std::uint32_t open = extended_bits & ~std::uint32_t{filter.mask}; open != 0; open &= open - 1) {
    words *= 2;
  }
  return words;
}

std::int32_t added_by_merging(const Filter& a, const Filter& b) { return width(both(a, b)) - width(a) - width(b); }

// Merges the two neighbouring filters that together pass the fewest other identifiers.
void merge_two(Filters& all) {
  unsigned best = 0;
  std::int32_t least = INT32_MAX;
  for (unsigned n = 0; n + 1 < all.number; ++n) {
    const std::int32_t added = added_by_merging(all.filter[n], all.filter[n + 1]);
    if (added < least) {
      least = added;
      best = n;
    }
  }
  all.filter[best] = both(all.filter[best], all.filter[best + 1]);
  --all.number;
  for (unsigned n = best + 1; n < all.number; ++n) {
    all.filter[n] = all.filter[n + 1];
  }
}

bool passes(const Filters& all, const Filter& filter) {
  for (unsigned n = 0; n < all.number; ++n) {
    const Filter& other = all.filter[n];
    if ((other.mask & ~filter.mask) == 0 && ((filter.word ^ other.word) & other.mask) == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num, unsigned most) {
  Filters all = {};
  for (unsigned n = 0; n < num; ++n) {
    const Filter filter = exactly(ids[n]);
    if (passes(all, filter)) {
      continue;
    }
    all.filter[all.number++] = filter;
    if (all.number > most) {
      merge_two(all);
    }
  }
  return all;
}

}  // namespace co::bxcan
