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

// Returns the number of 11-bit identifiers, or of groups of 2^15 29-bit identifiers, that pass a filter.
std::int32_t width(const Filter& filter) {
  constexpr unsigned bits_of_group = 15;
  const std::uint32_t compared = is_extended(filter) ? extended_mask : standard_mask;
  const unsigned open = mask_filters::count_bits(compared & ~filter.mask);
  const unsigned ignored = is_extended(filter) ? bits_of_group : 0;
  return std::int32_t{1} << (open > ignored ? open - ignored : 0);
}

std::int32_t added_by_merging(const Filter& a, const Filter& b) {
  return is_extended(a) != is_extended(b) ? INT32_MAX : width(mask_filters::both(a, b)) - width(a) - width(b);
}

bool fit(const Filters& all, const Capacity& capacity) {
  unsigned masked = 0;
  for (unsigned n = 0; n < all.number; ++n) {
    masked += needs_mask(all.filter[n]) ? 1U : 0U;
  }
  return all.number <= capacity.number && masked <= capacity.masked;
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
    if (mask_filters::passes(all, filter)) {
      continue;
    }
    all.filter[all.number++] = filter;
    while (!fit(all, capacity)) {
      mask_filters::merge_two(all, added_by_merging);
    }
  }
  sort(all);
  return all;
}

}  // namespace co::flexcan
