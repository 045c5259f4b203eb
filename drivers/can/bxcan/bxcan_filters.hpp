// SPDX-License-Identifier: Apache-2.0
/// \file bxcan_filters.hpp
/// Computes acceptance filters that pass the given identifiers, and few others.
#ifndef CO_DRIVERS_BXCAN_FILTERS_HPP_
#define CO_DRIVERS_BXCAN_FILTERS_HPP_

#include <cstdint>

#include "../mask_filters.hpp"

namespace co::bxcan {
/// \cond internal

/// Filter of 16 bits, two in each bank. A frame passes if its identifier equals the word in all bits of the mask. Of a
/// 29-bit identifier only the upper 14 bits are compared.
using Filter = mask_filters::Filter<std::uint16_t>;

inline constexpr unsigned filters_at_most = 54;  // one bank of 28 passes all frames while filters are changed

using Filters = mask_filters::Filters<std::uint16_t, filters_at_most>;

/// Returns at most \a most filters (1…filters_at_most) for \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, ascending.
Filters filters_of(const std::uint32_t* ids, unsigned num, unsigned most);

/// \endcond
}  // namespace co::bxcan

#endif
