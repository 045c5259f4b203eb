// SPDX-License-Identifier: Apache-2.0
/// \file acceptance.hpp
/// Computes up to four acceptance filters that accept all the given identifiers and few others.
#ifndef CO_DRIVERS_ZYNQMP_ACCEPTANCE_HPP_
#define CO_DRIVERS_ZYNQMP_ACCEPTANCE_HPP_

#include <cstdint>

#include "../mask_filters.hpp"

/// Internals of the driver co_can_zynqmp.h. Not for applications.
namespace co::zynqmp {

inline constexpr unsigned filters_at_most = 4;  ///< acceptance filters of a controller

/// Filter in the coding of the controller's registers (AFIR, AFMR).
using AcceptanceFilter = mask_filters::Filter<std::uint32_t>;

/// The acceptance filters of a controller.
struct Acceptance {
  AcceptanceFilter filter[filters_at_most + 1];  ///< the last one is used only during the computation
  std::uint8_t number;                           ///< filters in use; 0: all frames pass
};

/// Returns filters for \a ids: coded like in CO_IF_CAN_DRV_EX.Filter, in any order.
Acceptance acceptance_of(const std::uint32_t* ids, std::uint16_t num);

/// Returns an identifier of CO_IF_FRM in the coding of the registers; CO_IF_FRM_EXT: 29 bits. The remote bits are 0.
std::uint32_t identifier_word(std::uint32_t identifier);

}  // namespace co::zynqmp

#endif
