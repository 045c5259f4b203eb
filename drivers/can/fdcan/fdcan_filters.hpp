// SPDX-License-Identifier: Apache-2.0
/// \file fdcan_filters.hpp
/// Computes acceptance filters that pass the given identifiers, and few others.
#ifndef CO_DRIVERS_FDCAN_FILTERS_HPP_
#define CO_DRIVERS_FDCAN_FILTERS_HPP_

#include <cstdint>

namespace co::fdcan {
/// \cond internal

inline constexpr unsigned standard_filters = 28;
inline constexpr unsigned extended_filters = 8;

/// Filter: the identifiers first…last.
template <typename Id>
struct Range {
  Id first;
  Id last;
};

/// Ranges of identifiers; the last filter of the controller is reserved: it passes all frames while filters are
/// changed.
template <typename Id, unsigned filters>
struct Ranges {
  static constexpr unsigned most = filters - 1;
  Range<Id> range[most + 1];  // the last one is used only during the computation
  unsigned number;
};

struct Filters {
  Ranges<std::uint16_t, standard_filters> standard;
  Ranges<std::uint32_t, extended_filters> extended;
};

/// Returns filters for \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, ascending.
Filters filters_of(const std::uint32_t* ids, unsigned num);

/// \endcond
}  // namespace co::fdcan

#endif
