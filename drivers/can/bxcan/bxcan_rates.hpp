// SPDX-License-Identifier: Apache-2.0
/// \file bxcan_rates.hpp
/// Tables of bit rates for co_can_bxcan.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::bxcan_rates<45000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile.
#ifndef CO_DRIVERS_BXCAN_RATES_HPP_
#define CO_DRIVERS_BXCAN_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_bxcan.h"

namespace co {

/// Limits of the bit timing of the controller: prescaler, segment 1, segment 2, synchronisation jump width.
inline constexpr BitTimingLimits bxcan_limits = {1024, 16, 8, 4};  // [RM0090, 32.7.7: bit timing]

/// Returns the entry of CO_CAN_BXCAN.Rates for a bit timing; \a baud in bit/s.
constexpr CO_CAN_BXCAN_RATE bxcan_rate(std::uint32_t baud, const BitTiming& timing) {
  return {baud, ((timing.jump - 1U) << 24) | ((timing.segment2 - 1U) << 20) | ((timing.segment1 - 1U) << 16) |
                    (timing.prescaler - 1U)};
}

/// Table for CO_CAN_BXCAN.Rates. \a clock: clock of the APB bus of the controller in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_BXCAN_RATE, sizeof...(rates)> bxcan_rates = {
    bxcan_rate(rates, bit_timing<clock, rates, bxcan_limits>)...};

}  // namespace co

#endif
