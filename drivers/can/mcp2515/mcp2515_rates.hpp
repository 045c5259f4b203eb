// SPDX-License-Identifier: Apache-2.0
/// \file mcp2515_rates.hpp
/// Tables of bit rates for co_can_mcp2515.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::mcp2515_rates<16000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its crystal does not compile.
#ifndef CO_DRIVERS_MCP2515_RATES_HPP_
#define CO_DRIVERS_MCP2515_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_mcp2515.h"

namespace co {

/// Limits of the bit timing; the clock for it is half of that of the crystal. [MCP2515, 5.0: bit timing]
inline constexpr BitTimingLimits mcp2515_limits = {64, 16, 8, 4, 2};

/// Returns the entry of CO_CAN_MCP2515.Rates for a bit timing; \a baud in bit/s. The synchronisation jump width must be
/// shorter than phase segment 2. [MCP2515, 5.3]
constexpr CO_CAN_MCP2515_RATE mcp2515_rate(std::uint32_t baud, const BitTiming& timing) {
  const unsigned jump = timing.jump < timing.segment2 ? timing.jump : timing.segment2 - 1U;
  return {baud, CO_CAN_MCP2515_TIMING(timing.prescaler, timing.segment1, timing.segment2, jump)};
}

/// Table for CO_CAN_MCP2515.Rates. \a clock: of the crystal in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_MCP2515_RATE, sizeof...(rates)> mcp2515_rates = {
    mcp2515_rate(rates, bit_timing<clock / 2, rates, mcp2515_limits>)...};

}  // namespace co

#endif
