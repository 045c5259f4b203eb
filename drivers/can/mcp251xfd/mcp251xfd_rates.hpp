// SPDX-License-Identifier: Apache-2.0
/// \file mcp251xfd_rates.hpp
/// Tables of bit rates for co_can_mcp251xfd.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::mcp251xfd_rates<40000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile.
#ifndef CO_DRIVERS_MCP251XFD_RATES_HPP_
#define CO_DRIVERS_MCP251XFD_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_mcp251xfd.h"

namespace co {

/// Limits of the bit timing. [MCP25xxFD: C1NBTCFG]
inline constexpr BitTimingLimits mcp251xfd_limits = {256, 256, 128, 128};

/// Returns the entry of CO_CAN_MCP251XFD.Rates for a bit timing; \a baud in bit/s.
constexpr CO_CAN_MCP251XFD_RATE mcp251xfd_rate(std::uint32_t baud, const BitTiming& timing) {
  return {baud, CO_CAN_MCP251XFD_TIMING(timing.prescaler, timing.segment1, timing.segment2, timing.jump)};
}

/// Table for CO_CAN_MCP251XFD.Rates. \a clock: SYSCLK in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_MCP251XFD_RATE, sizeof...(rates)> mcp251xfd_rates = {
    mcp251xfd_rate(rates, bit_timing<clock, rates, mcp251xfd_limits>)...};

}  // namespace co

#endif
