// SPDX-License-Identifier: Apache-2.0
/// \file sja1000_filters.hpp
/// Computes the two acceptance filters that pass the given identifiers, and few others.
#ifndef CO_DRIVERS_SJA1000_FILTERS_HPP_
#define CO_DRIVERS_SJA1000_FILTERS_HPP_

#include <cstdint>

namespace co::sja1000 {
/// \cond internal

/// Filter of 11 bits. A frame passes if its 11-bit identifier, or the upper 11 bits of its 29-bit one, equals the word
/// in all bits of the mask.
struct Filter {
  std::uint16_t word;
  std::uint16_t mask;
};

struct Filters {
  Filter filter[2];
};

/// Returns the pair of filters for \a ids that passes the fewest identifiers among the pairs that differ in a bit that
/// both compare. \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, in any order.
Filters filters_of(const std::uint32_t* ids, unsigned num);

/// Returns whether all \a ids pass.
bool all_pass(const Filters& filters, const std::uint32_t* ids, unsigned num);

/// Returns whether all frames pass.
inline bool is_open(const Filters& filters) { return filters.filter[0].mask == 0 || filters.filter[1].mask == 0; }

/// \endcond
}  // namespace co::sja1000

#endif
