// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_rates.hpp
/// Tables of bit rates for co_can_flexcan.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::flexcan_rates<40000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile. flexcan_rates uses CTRL1, which all
/// controllers have; flexcan_wide_rates uses CBT of controllers for CAN FD, with more quanta per bit.
#ifndef CO_DRIVERS_FLEXCAN_RATES_HPP_
#define CO_DRIVERS_FLEXCAN_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_flexcan.h"

namespace co {

/// Ranges of the bit timing in CTRL1. Segment 1 is the propagation segment and phase segment 1, 1…8 quanta each.
inline constexpr BitTimingLimits flexcan_limits = {256, 16, 8, 4, 2};  // [K20, 45.4.8: Protocol timing]
/// Ranges of the bit timing in CBT: propagation segment 1…64, phase segment 1 1…32 quanta.
inline constexpr BitTimingLimits flexcan_wide_limits = {1024, 96, 32, 16, 2};  // [register header: CBT]

/// \cond internal
// Returns the quanta of phase segment 1: those of phase segment 2, or more if the propagation segment is too short.
constexpr std::uint32_t flexcan_phase1(const BitTiming& timing, std::uint32_t longest_propagation) {
  const std::uint32_t rest = timing.segment1 > longest_propagation ? timing.segment1 - longest_propagation : 1U;
  const std::uint32_t wanted = timing.segment2 < timing.segment1 ? timing.segment2 : timing.segment1 - 1U;
  return rest > wanted ? rest : wanted;
}
/// \endcond

/// Returns the entry of CO_CAN_FLEXCAN.Rates for a bit timing within flexcan_limits; \a baud in bit/s.
constexpr CO_CAN_FLEXCAN_RATE flexcan_rate(std::uint32_t baud, const BitTiming& timing) {
  const std::uint32_t phase1 = flexcan_phase1(timing, 8);
  return {baud,
          ((timing.prescaler - 1U) << 24) | ((timing.jump - 1U) << 22) | ((phase1 - 1U) << 19) |
              ((timing.segment2 - 1U) << 16) | (timing.segment1 - phase1 - 1U),
          0};
}

/// Returns the entry of CO_CAN_FLEXCAN.Rates for a bit timing within flexcan_wide_limits; \a baud in bit/s.
constexpr CO_CAN_FLEXCAN_RATE flexcan_wide_rate(std::uint32_t baud, const BitTiming& timing) {
  const std::uint32_t phase1 = flexcan_phase1(timing, 64);
  return {baud, 0,
          CO_FLEXCAN_CBT_BTF | ((timing.prescaler - 1U) << 21) | ((timing.jump - 1U) << 16) |
              ((timing.segment1 - phase1 - 1U) << 10) | ((phase1 - 1U) << 5) | (timing.segment2 - 1U)};
}

/// Table for CO_CAN_FLEXCAN.Rates. \a clock: clock of the protocol engine in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_FLEXCAN_RATE, sizeof...(rates)> flexcan_rates = {
    flexcan_rate(rates, bit_timing<clock, rates, flexcan_limits>)...};

/// Like flexcan_rates, for controllers with the register CBT.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_FLEXCAN_RATE, sizeof...(rates)> flexcan_wide_rates = {
    flexcan_wide_rate(rates, bit_timing<clock, rates, flexcan_wide_limits>)...};

}  // namespace co

#endif
