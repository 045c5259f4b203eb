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

// Returns the number of combinations of the compared bits that pass a filter.
std::int32_t width(const Filter& filter) {
  return std::int32_t{1} << mask_filters::count_bits(extended_bits & ~std::uint32_t{filter.mask});
}

std::int32_t added_by_merging(const Filter& a, const Filter& b) {
  return width(mask_filters::both(a, b)) - width(a) - width(b);
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num, unsigned most) {
  Filters all = {};
  for (unsigned n = 0; n < num; ++n) {
    const Filter filter = exactly(ids[n]);
    if (mask_filters::passes(all, filter)) {
      continue;
    }
    all.filter[all.number++] = filter;
    if (all.number > most) {
      mask_filters::merge_two(all, added_by_merging);
    }
  }
  return all;
}

}  // namespace co::bxcan
