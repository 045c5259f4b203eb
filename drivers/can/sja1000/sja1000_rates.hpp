// SPDX-License-Identifier: Apache-2.0
/// \file sja1000_rates.hpp
/// Tables of bit rates for co_can_sja1000.h and co_can_twai.h, computed and checked at compile time (bit_timing.hpp).
///
///     static constexpr auto& rates = co::sja1000_rates<16000000, 125000, 250000, 500000, 1000000>;
///     can.Rates = rates.data();  can.RateNum = rates.size();
///
/// A bit rate that the controller cannot derive from its clock does not compile.
#ifndef CO_DRIVERS_SJA1000_RATES_HPP_
#define CO_DRIVERS_SJA1000_RATES_HPP_

#include <array>

#include "../bit_timing.hpp"
#include "co_can_sja1000.h"
#include "sja1000_registers.h"

namespace co {

/// Ranges of the bit timing of SJA1000 and of the TWAI of ESP32; the clock for them is half of that of the controller.
inline constexpr BitTimingLimits sja1000_limits = {64, 16, 8, 4};  // [SJA1000, 6.5.1 and 6.5.2]
/// Likewise, of the TWAI of ESP32-C3, S2, S3, C6 and H2.
inline constexpr BitTimingLimits twai_limits = {8192, 16, 8, 4};  // [twai_struct.h of ESP32-C3: BTR0[12:0]]

/// \cond internal
constexpr CO_CAN_SJA1000_RATE sja1000_rate_with(std::uint32_t baud, const BitTiming& timing, unsigned shift) {
  const std::uint32_t first = (timing.prescaler - 1U) | ((timing.jump - 1U) << shift);
  const std::uint32_t second = (timing.segment1 - 1U) | ((timing.segment2 - 1U) << CO_SJA1000_BTR1_TSEG2_SHIFT);
  return {baud, first | (second << 16)};
}
/// \endcond

/// Returns an entry of CO_CAN_SJA1000.Rates, or of CO_CAN_TWAI.Rates for ESP32; \a baud in bit/s.
constexpr CO_CAN_SJA1000_RATE sja1000_rate(std::uint32_t baud, const BitTiming& timing) {
  return sja1000_rate_with(baud, timing, CO_SJA1000_BTR0_SJW_SHIFT);
}
/// Returns an entry of CO_CAN_TWAI.Rates for ESP32-C3, S2, S3, C6 and H2; \a baud in bit/s.
constexpr CO_CAN_SJA1000_RATE twai_rate(std::uint32_t baud, const BitTiming& timing) {
  return sja1000_rate_with(baud, timing, CO_TWAI_BTR0_SJW_SHIFT);
}

/// Table for CO_CAN_SJA1000.Rates, or for CO_CAN_TWAI.Rates for ESP32. \a clock: of the crystal of SJA1000, or of the
/// APB, in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_SJA1000_RATE, sizeof...(rates)> sja1000_rates = {
    sja1000_rate(rates, bit_timing<clock / 2, rates, sja1000_limits>)...};

/// Table for CO_CAN_TWAI.Rates for ESP32-C3, S2, S3, C6 and H2. \a clock: of TWAI in Hz; \a rates: bit/s.
template <std::uint32_t clock, std::uint32_t... rates>
inline constexpr std::array<CO_CAN_SJA1000_RATE, sizeof...(rates)> twai_rates = {
    twai_rate(rates, bit_timing<clock / 2, rates, twai_limits>)...};

}  // namespace co

#endif
