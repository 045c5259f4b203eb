// SPDX-License-Identifier: Apache-2.0
/// \file acceptance.hpp
/// Four acceptance filters that let given identifiers through, and as few others as can be seen at a glance.
#ifndef CO_DRIVERS_ZYNQMP_ACCEPTANCE_HPP_
#define CO_DRIVERS_ZYNQMP_ACCEPTANCE_HPP_

#include <cstdint>

namespace co::zynqmp {

inline constexpr unsigned filters_at_most = 4;

/// As the registers of the controller hold them. A frame passes if its identifier has the bits of the word where the
/// mask is 1.
struct AcceptanceFilter {
  std::uint32_t mask;
  std::uint32_t word;
};

struct Acceptance {
  AcceptanceFilter filter[filters_at_most + 1];  // the last one is of no use to the caller
  std::uint8_t number;                           // 0: everything passes
};

/// \a ids: as in CO_IF_CAN_DRV_EX.Filter, any order.
Acceptance acceptance_of(const std::uint32_t* ids, std::uint16_t num);

/// An identifier (with CO_IF_FRM_EXT) as it stands in the registers, without the bits of a remote frame.
std::uint32_t identifier_word(std::uint32_t identifier);

}  // namespace co::zynqmp

#endif
