// SPDX-License-Identifier: Apache-2.0
#include "acceptance.hpp"

#include "co_if_can.h"
#include "registers.hpp"

namespace co::zynqmp {
namespace {

// Bits that distinguish identifiers: base and IDE, and the extension of 29-bit identifiers.
constexpr std::uint32_t standard_bits = (0x7FFU << standard_shift) | extended;
constexpr std::uint32_t extended_bits = standard_bits | (0x3FFFFU << extension_shift);

// Returns the filter that only one identifier passes.
AcceptanceFilter exactly(std::uint32_t identifier) {
  const bool is_extended = (identifier & CO_IF_FRM_EXT) != 0;
  return {identifier_word(identifier), is_extended ? extended_bits : standard_bits};
}

// Returns the number of identifiers that pass a filter.
std::int32_t width(const AcceptanceFilter& filter) {
  const bool is_standard = (filter.mask & extended) != 0 && (filter.word & extended) == 0;
  return std::int32_t{1} << mask_filters::count_bits((is_standard ? standard_bits : extended_bits) & ~filter.mask);
}

// Returns the number of identifiers that pass a merged filter, but neither of its parts; negative if the parts overlap.
std::int32_t added_by_merging(const AcceptanceFilter& a, const AcceptanceFilter& b) {
  return width(mask_filters::both(a, b)) - width(a) - width(b);
}

// Merges the pair of filters that adds the fewest other identifiers; duplicates are merged first. Called with one
// filter more than the controller has.
void merge_two(Acceptance& all) {
  struct Pair {
    std::uint8_t first;
    std::uint8_t second;
  };
  constexpr Pair pairs[] = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  static_assert(sizeof pairs / sizeof pairs[0] == (filters_at_most + 1) * filters_at_most / 2);
  Pair best = pairs[0];
  std::int32_t least = INT32_MAX;
  for (const Pair pair : pairs) {
    const std::int32_t added = added_by_merging(all.filter[pair.first], all.filter[pair.second]);
    if (added < least) {
      least = added;
      best = pair;
    }
  }
  all.filter[best.first] = mask_filters::both(all.filter[best.first], all.filter[best.second]);
  all.filter[best.second] = all.filter[--all.number];
}

void add(Acceptance& all, const AcceptanceFilter& filter) {
  all.filter[all.number++] = filter;
  if (all.number > filters_at_most) {
    merge_two(all);
  }
}

}  // namespace

std::uint32_t identifier_word(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  if ((identifier & CO_IF_FRM_EXT) == 0) {
    return id << standard_shift;
  }
  return ((id >> 18) << standard_shift) | extended | ((id & 0x3FFFF) << extension_shift);
}

Acceptance acceptance_of(const std::uint32_t* ids, std::uint16_t num) {
  Acceptance all = {};
  for (unsigned n = 0; n < num; ++n) {
    add(all, exactly(ids[n]));
  }
  return all;
}

}  // namespace co::zynqmp
