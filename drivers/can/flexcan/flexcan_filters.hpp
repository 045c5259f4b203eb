// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_filters.hpp
/// Computes acceptance filters that pass the given identifiers, and few others.
#ifndef CO_DRIVERS_FLEXCAN_FILTERS_HPP_
#define CO_DRIVERS_FLEXCAN_FILTERS_HPP_

#include <cstdint>

#include "../mask_filters.hpp"

namespace co::flexcan {
/// \cond internal

/// Filter in format A of the receive FIFO: bit 31 RTR, which is never compared, bit 30 IDE, which always is, and the
/// identifier. A frame passes if it equals the word in all bits of the mask.
using Filter = mask_filters::Filter<std::uint32_t>;

/// Mask of a filter for one 11-bit identifier, and for one 29-bit identifier.
inline constexpr std::uint32_t standard_mask = 0x7FF80000;
inline constexpr std::uint32_t extended_mask = 0x7FFFFFFE;

inline constexpr unsigned filters_at_most = 40;

/// Filters of a controller.
struct Capacity {
  unsigned number;  ///< 2…filters_at_most
  unsigned masked;  ///< those with a mask of their own, 2…number; the others compare exactly one 11-bit identifier
};

using Filters = mask_filters::Filters<std::uint32_t, filters_at_most>;

/// Returns filters for \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, ascending. Those that need a mask come first.
Filters filters_of(const std::uint32_t* ids, unsigned num, const Capacity& capacity);

/// \endcond
}  // namespace co::flexcan

#endif
