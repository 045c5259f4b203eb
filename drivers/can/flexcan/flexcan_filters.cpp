// SPDX-License-Identifier: Apache-2.0
#include "flexcan_filters.hpp"

#include "../transmit.hpp"
#include "flexcan_registers.h"

namespace co::flexcan {
namespace {

Filter exactly(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  if (!transmit::is_extended(identifier)) {
    return {id << CO_FLEXCAN_FIFO_STID_SHIFT, standard_mask};
  }
  return {CO_FLEXCAN_FIFO_IDE | (id << CO_FLEXCAN_FIFO_EXID_SHIFT), extended_mask};
}

bool is_extended(const Filter& filter) { return (filter.word & CO_FLEXCAN_FIFO_IDE) != 0; }

bool needs_mask(const Filter& filter) { return is_extended(filter) || filter.mask != standard_mask; }

Filter both(const Filter& a, const Filter& b) {
  const std::uint32_t mask = a.mask & b.mask & ~(a.word ^ b.word);
  return {a.word & mask, mask};
}

// Returns the number of 11-bit identifiers, or of groups of 2^15 29-bit identifiers, that pass a filter.
std::int32_t width(const Filter& filter) {
  constexpr unsigned bits_of_group = 15;
  unsigned open = 0;
  const std::uint32_t compared = is_extended(filter) ? extended_mask : standard_mask;
  for (std::uint32_t bits = compared & ~filter.mask; bits != 0; bits &= bits - 1) {
    ++open;
  }
  const unsigned ignored = is_extended(filter) ? bits_of_group : 0;
  return std::int32_t{1} << (open > ignored ? open - ignored : 0);
}

std::int32_t added_by_merging(const Filter& a, const Filter& b) {
  return is_extended(a) != is_extended(b) ? INT32_MAX : width(both(a, b)) - width(a) - width(b);
}

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

bool fit(const Filters& all, const Capacity& capacity) {
  unsigned masked = 0;
  for (unsigned n = 0; n < all.number; ++n) {
    masked += needs_mask(all.filter[n]) ? 1U : 0U;
  }
  return all.number <= capacity.number && masked <= capacity.masked;
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

// Moves the filters that need a mask to the beginning.
void sort(Filters& all) {
  unsigned masked = 0;
  for (unsigned n = 0; n < all.number; ++n) {
    if (needs_mask(all.filter[n])) {
      const Filter other = all.filter[masked];
      all.filter[masked++] = all.filter[n];
      all.filter[n] = other;
    }
  }
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num, const Capacity& capacity) {
  Filters all = {};
  for (unsigned n = 0; n < num; ++n) {
    const Filter filter = exactly(ids[n]);
    if (passes(all, filter)) {
      continue;
    }
    all.filter[all.number++] = filter;
    while (!fit(all, capacity)) {
      merge_two(all);
    }
  }
  sort(all);
  return all;
}

}  // namespace co::flexcan
