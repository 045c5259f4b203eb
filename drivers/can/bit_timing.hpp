// SPDX-License-Identifier: Apache-2.0
/// \file bit_timing.hpp
/// Computes the bit timing of a CAN controller at compile time. For drivers, and for boards that have to check whether
/// their clock suits a bit rate.
///
///     inline constexpr co::BitTimingLimits limits = {256, 16, 8, 4};        // of the data sheet
///     constexpr co::BitTiming timing = co::bit_timing<24000000, 500000, limits>;
///     BTR = (timing.jump - 1) << 7 | (timing.segment2 - 1) << 4 | (timing.segment1 - 1);
///
/// A bit consists of SYNC_SEG (one quantum), segment 1 (PROP_SEG and PHASE_SEG1), the sample point, and segment 2
/// (PHASE_SEG2). A quantum is `prescaler` periods of the clock. [ISO 11898-1]
/// CiA 301 recommends a sample point at 87.5 % of the bit, and allows 85…90 % (75…90 % from 800 kbit/s on). [301] Among
/// the timings that a controller supports, the one with the rate nearest to the required rate is chosen; among equal
/// ones, the one with the sample point nearest to 87.5 %; among these, the one with most quanta. A combination of
/// clock, rate and controller without a valid timing does not compile: the message names clock and rate.
#ifndef CO_DRIVERS_BIT_TIMING_HPP_
#define CO_DRIVERS_BIT_TIMING_HPP_

#include <cstdint>

namespace co {

/// The bit rates of CiA 301, bit/s. [301]
inline constexpr std::uint32_t cia_bit_rates[] = {10000, 20000, 50000, 125000, 250000, 500000, 800000, 1000000};

/// Limits of a controller, in quanta and clock periods (not in the coding of its registers).
struct BitTimingLimits {
  std::uint16_t prescaler;             ///< 1…
  std::uint16_t segment1;              ///< 1…
  std::uint16_t segment2;              ///< segment2_from…
  std::uint16_t jump;                  ///< 1…: synchronisation jump width (SJW)
  std::uint16_t segment2_from = 1;     ///< minimum; 2 for controllers that need time to process the sampled bit
  std::uint32_t deviation_ppm = 1000;  ///< tolerance of the bit rate: half of what the network allows; the crystals use
                                       ///< the other half
};

/// Bit timing; prescaler 0 means: no valid timing.
struct BitTiming {
  std::uint16_t prescaler;  ///< clock periods in a quantum
  std::uint16_t segment1;   ///< quanta of PROP_SEG and PHASE_SEG1
  std::uint16_t segment2;   ///< quanta of PHASE_SEG2
  std::uint16_t jump;       ///< synchronisation jump width (SJW), quanta

  /// Returns the quanta of a bit.
  constexpr unsigned quanta() const { return 1U + segment1 + segment2; }
  /// Returns the sample point in units of 0.01 % of the bit.
  constexpr unsigned sample_point() const { return (1U + segment1) * 10000U / quanta(); }
  /// Returns the bit rate in bit/s, rounded down. \a clock: Hz. Only for a valid timing.
  constexpr std::uint32_t rate(std::uint32_t clock) const { return clock / (prescaler * quanta()); }
};

/// \cond internal
namespace timing {

inline constexpr unsigned fewest_quanta = 8;  // [ISO 11898-1]
inline constexpr unsigned sample_point = 8750;
inline constexpr unsigned latest_sample = 9000;

constexpr unsigned earliest_sample(std::uint32_t rate) { return rate >= 800000 ? 7500 : 8500; }

constexpr std::uint64_t distance(std::uint64_t a, std::uint64_t b) { return a < b ? b - a : a - b; }

constexpr unsigned least(unsigned a, unsigned b) { return a < b ? a : b; }

// Returns the number of quanta in segment 2 that places the sample point as near to 87.5 % as possible.
constexpr unsigned segment2_of(unsigned quanta, const BitTimingLimits& limits) {
  const unsigned wanted = (quanta + 4) / 8;
  const unsigned at_least = quanta - 1 > limits.segment1 ? quanta - 1 - limits.segment1 : 1;
  const unsigned from = at_least > limits.segment2_from ? at_least : limits.segment2_from;
  return wanted < from ? from : least(wanted, limits.segment2);
}

// Returns the timing with the given number of quanta per bit; prescaler 0 if it would break a limit.
constexpr BitTiming of(std::uint32_t clock, std::uint32_t rate, unsigned quanta, const BitTimingLimits& limits) {
  const std::uint64_t quanta_per_second = std::uint64_t{rate} * quanta;
  const std::uint64_t prescaler = (clock + quanta_per_second / 2) / quanta_per_second;
  const unsigned segment2 = segment2_of(quanta, limits);
  const BitTiming timing = {static_cast<std::uint16_t>(prescaler), static_cast<std::uint16_t>(quanta - 1 - segment2),
                            static_cast<std::uint16_t>(segment2),
                            static_cast<std::uint16_t>(least(segment2, limits.jump))};
  const bool divides = prescaler >= 1 && prescaler <= limits.prescaler;
  const bool fits = timing.segment1 >= 1 && timing.segment1 <= limits.segment1 && segment2 <= limits.segment2;
  const bool samples = timing.sample_point() >= earliest_sample(rate) && timing.sample_point() <= latest_sample;
  const bool exact = divides && distance(prescaler * quanta_per_second, clock) * 1000000 <=
                                    prescaler * quanta_per_second * limits.deviation_ppm;
  return divides && fits && samples && exact ? timing : BitTiming{};
}

constexpr bool is_better(const BitTiming& a, const BitTiming& b, std::uint32_t clock, std::uint32_t rate) {
  if (a.prescaler == 0 || b.prescaler == 0) {
    return a.prescaler != 0;
  }
  const std::uint64_t a_off = distance(std::uint64_t{rate} * a.prescaler * a.quanta(), clock);
  const std::uint64_t b_off = distance(std::uint64_t{rate} * b.prescaler * b.quanta(), clock);
  if (a_off != b_off) {
    return a_off < b_off;
  }
  return distance(a.sample_point(), sample_point) <= distance(b.sample_point(), sample_point);
}

}  // namespace timing
/// \endcond

/// Returns the bit timing for a clock (Hz) or rate (bit/s) that is known only at run time; prescaler 0: there is none.
constexpr BitTiming find_bit_timing(std::uint32_t clock, std::uint32_t rate, const BitTimingLimits& limits) {
  BitTiming best = {};
  const unsigned most = 1U + limits.segment1 + limits.segment2;
  for (unsigned quanta = timing::fewest_quanta; quanta <= most && rate != 0; ++quanta) {
    const BitTiming timing = timing::of(clock, rate, quanta, limits);
    best = timing::is_better(timing, best, clock, rate) ? timing : best;
  }
  return best;
}

/// \cond internal
template <std::uint32_t clock, std::uint32_t rate, const BitTimingLimits& limits>
struct BitTimingOf {
  static constexpr BitTiming value = find_bit_timing(clock, rate, limits);
  static_assert(value.prescaler != 0, "the controller has no bit timing for this bit rate at this clock");
};
/// \endcond

/// Bit timing, checked at compile time; \a clock in Hz, \a rate in bit/s.
template <std::uint32_t clock, std::uint32_t rate, const BitTimingLimits& limits>
inline constexpr BitTiming bit_timing = BitTimingOf<clock, rate, limits>::value;

}  // namespace co

#endif
