// SPDX-License-Identifier: Apache-2.0
#include "mcp2515_filters.hpp"

namespace co::mcp2515 {
namespace {

using identifiers::all_bits;
using identifiers::width;
constexpr unsigned most_items = 12;
using Items = mask_filters::Filters<std::uint32_t, most_items>;

// Filters with a common mask.
struct Group {
  std::uint32_t mask = all_bits;
  std::uint32_t word[most_items] = {};
  unsigned number = 0;

  std::int32_t cost() const {
    std::int32_t sum = 0;
    for (unsigned n = 0; n < number; ++n) {
      sum += width({word[n], mask});
    }
    return sum;
  }
};

// Returns the different words that the items of a set have under a mask; bit n of the set: item n.
Group group_with(const Items& items, unsigned set, std::uint32_t mask) {
  Group group;
  group.mask = mask;
  for (unsigned n = 0; n < items.number; ++n) {
    const std::uint32_t word = items.filter[n].word & mask;
    bool is_new = ((set >> n) & 1U) != 0;
    for (unsigned i = 0; i < group.number; ++i) {
      is_new = is_new && group.word[i] != word;
    }
    if (is_new) {
      group.word[group.number++] = word;
    }
  }
  return group;
}

std::uint32_t lowest_bit(std::uint32_t bits) { return bits & (~bits + 1); }

// Returns the group after the removal of the bit from the mask that leaves the fewest words; among these, the one that
// passes the fewest identifiers.
Group without_a_bit(const Items& items, unsigned set, const Group& group) {
  Group best = group;
  bool is_first = true;
  for (std::uint32_t left = group.mask & ~extended_bit; left != 0; left &= left - 1) {
    const Group other = group_with(items, set, group.mask & ~lowest_bit(left));
    const bool is_better =
        other.number < best.number || (other.number == best.number && (is_first || other.cost() < best.cost()));
    best = is_better ? other : best;
    is_first = false;
  }
  return best;
}

// Returns at most \a most filters with a common mask that pass the items of a set. Bits that need not be ignored any
// more are compared again.
Group group_of(const Items& items, unsigned set, unsigned most) {
  std::uint32_t mask = all_bits;
  for (unsigned n = 0; n < items.number; ++n) {
    mask &= ((set >> n) & 1U) != 0 ? items.filter[n].mask : all_bits;
  }
  Group group = group_with(items, set, mask);
  while (group.number > most) {
    group = without_a_bit(items, set, group);
  }
  for (std::uint32_t left = mask & ~group.mask; left != 0; left &= left - 1) {
    const Group other = group_with(items, set, group.mask | lowest_bit(left));
    group = other.number <= most ? other : group;
  }
  return group;
}

// Filters of both receive buffers.
struct Pair {
  Group group[receive_buffers];

  std::int32_t cost() const { return group[0].cost() + group[1].cost(); }
};

// Returns the filters if buffer 0 receives a set of items, and buffer 1 the others.
Pair pair_with(const Items& items, unsigned first) {
  const unsigned all = (1U << items.number) - 1;
  return {{group_of(items, first, filters_of_buffer[0]), group_of(items, all & ~first, filters_of_buffer[1])}};
}

// Moves the item between the buffers whose move leaves the fewest identifiers that pass. Returns the new set of buffer
// 0, the present one if no move is better.
unsigned improve(const Items& items, unsigned first, Pair& best) {
  unsigned better = first;
  for (unsigned n = 0; n < items.number; ++n) {
    const Pair other = pair_with(items, first ^ (1U << n));
    if (other.cost() < best.cost()) {
      best = other;
      better = first ^ (1U << n);
    }
  }
  return better;
}

Pair best_pair_from(const Items& items, unsigned first) {
  Pair best = pair_with(items, first);
  for (unsigned next = improve(items, first, best); next != first; next = improve(items, first, best)) {
    first = next;
  }
  return best;
}

// Copies the filters of a buffer. Filters that are not needed repeat others.
void store(Filters& filters, unsigned buffer, const Group& group) {
  filters.Mask[buffer] = group.mask & ~extended_bit;
  const unsigned first = buffer == 0 ? 0 : filters_of_buffer[0];
  for (unsigned n = 0; n < filters_of_buffer[buffer]; ++n) {
    filters.Word[first + n] = group.word[n < group.number ? n : 0];
  }
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num) {
  constexpr std::uint32_t nobody = CO_IF_FRM_EXT | 0x1FFFFFFF;
  const Items items =
      num != 0 ? identifiers::items_of<most_items>(ids, num) : identifiers::items_of<most_items>(&nobody, 1);
  Pair best = best_pair_from(items, 0);
  const Pair other = best_pair_from(items, (1U << items.number) - 1);
  best = other.cost() < best.cost() ? other : best;
  Filters filters = {};
  store(filters, 0, best.group[0].number != 0 ? best.group[0] : best.group[1]);
  store(filters, 1, best.group[1].number != 0 ? best.group[1] : best.group[0]);
  return filters;
}

bool all_pass(const Filters& filters, const std::uint32_t* ids, unsigned num) {
  for (unsigned n = 0; n < num; ++n) {
    const std::uint32_t word = word_of(ids[n]);
    bool passes = false;
    for (unsigned i = 0; i < filter_number; ++i) {
      const std::uint32_t mask = filters.Mask[i < filters_of_buffer[0] ? 0 : 1] | extended_bit;
      passes = passes || ((word ^ filters.Word[i]) & mask) == 0;
    }
    if (!passes) {
      return false;
    }
  }
  return true;
}

}  // namespace co::mcp2515
