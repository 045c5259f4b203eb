// SPDX-License-Identifier: Apache-2.0
/// \file fdcan_rates.hpp
/// Tables of bit rates for co_can_fdcan.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::fdcan_rates<170000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile.
#ifndef CO_DRIVERS_FDCAN_RATES_HPP_
#define CO_DRIVERS_FDCAN_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_fdcan.h"

namespace co {

/// Ranges of the bit timing of the controller.
inline constexpr BitTimingLimits fdcan_limits = {512, 256, 128, 128, 2};  // [M_CAN, 2.3.8: NBTP]

/// Returns the entry of CO_CAN_FDCAN.Rates for a bit timing; \a baud in bit/s.
constexpr CO_CAN_FDCAN_RATE fdcan_rate(std::uint32_t baud, const BitTiming& timing) {
  return {baud, ((timing.jump - 1U) << 25) | ((timing.prescaler - 1U) << 16) | ((timing.segment1 - 1U) << 8) |
                    (timing.segment2 - 1U)};
}

/// Table for CO_CAN_FDCAN.Rates. \a clock: kernel clock of the controller in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_FDCAN_RATE, sizeof...(rates)> fdcan_rates = {
    fdcan_rate(rates, bit_timing<clock, rates, fdcan_limits>)...};

}  // namespace co

#endif
