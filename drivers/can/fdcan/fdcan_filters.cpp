// SPDX-License-Identifier: Apache-2.0
#include "fdcan_filters.hpp"

#include "../transmit.hpp"

namespace co::fdcan {
namespace {

// Merges the two neighbouring ranges with the fewest identifiers between them.
template <typename Id, unsigned filters>
void merge_two(Ranges<Id, filters>& all) {
  unsigned best = 0;
  std::uint32_t least = UINT32_MAX;
  for (unsigned n = 0; n + 1 < all.number; ++n) {
    const std::uint32_t gap = std::uint32_t{all.range[n + 1].first} - all.range[n].last;
    if (gap < least) {
      least = gap;
      best = n;
    }
  }
  all.range[best].last = all.range[best + 1].last;
  --all.number;
  for (unsigned n = best + 1; n < all.number; ++n) {
    all.range[n] = all.range[n + 1];
  }
}

// Adds an identifier that is not lower than those before it.
template <typename Id, unsigned filters>
void add(Ranges<Id, filters>& all, Id id) {
  if (all.number != 0 && std::uint32_t{id} - all.range[all.number - 1].last <= 1) {
    all.range[all.number - 1].last = id;
    return;
  }
  all.range[all.number++] = {id, id};
  if (all.number > Ranges<Id, filters>::most) {
    merge_two(all);
  }
}

}  // namespace

Filters filters_of(const std::uint32_t* ids, unsigned num) {
  Filters all = {};
  for (unsigned n = 0; n < num; ++n) {
    const std::uint32_t id = ids[n] & CO_IF_FRM_ID;
    if (transmit::is_extended(ids[n])) {
      add(all.extended, id);
    } else {
      add(all.standard, static_cast<std::uint16_t>(id));
    }
  }
  return all;
}

}  // namespace co::fdcan
