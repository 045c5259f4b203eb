// SPDX-License-Identifier: Apache-2.0
/// \file zynqmp_rates.hpp
/// Tables of bit rates for co_can_zynqmp.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::zynqmp_rates<24000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile.
#ifndef CO_DRIVERS_ZYNQMP_RATES_HPP_
#define CO_DRIVERS_ZYNQMP_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_zynqmp.h"

namespace co {

/// Limits of the bit timing of the controllers: prescaler, segment 1, segment 2, synchronisation jump width.
inline constexpr BitTimingLimits zynqmp_limits = {256, 16, 8, 4};

/// Returns an element of CO_CAN_ZYNQMP.Rates. \a baud: bit/s; \a timing: a valid timing for it.
constexpr CO_CAN_ZYNQMP_RATE zynqmp_rate(std::uint32_t baud, const BitTiming& timing) {
  return {baud, static_cast<std::uint16_t>(timing.prescaler - 1),
          static_cast<std::uint16_t>(((timing.jump - 1) << 7) | ((timing.segment2 - 1) << 4) | (timing.segment1 - 1))};
}

/// Table for CO_CAN_ZYNQMP.Rates. \a clock: the CAN reference clock in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_ZYNQMP_RATE, sizeof...(rates)> zynqmp_rates = {
    zynqmp_rate(rates, bit_timing<clock, rates, zynqmp_limits>)...};

}  // namespace co

#endif
