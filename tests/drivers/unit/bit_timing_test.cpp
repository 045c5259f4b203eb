// SPDX-License-Identifier: Apache-2.0
#include "bit_timing.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "support/stride.hpp"
#include "zynqmp_rates.hpp"

namespace {

using co::BitTiming;
using co::BitTimingLimits;

// Limits of controllers, from their data sheets.
constexpr BitTimingLimits zynqmp = {256, 16, 8, 4};
constexpr BitTimingLimits bxcan = {1024, 16, 8, 4};
constexpr BitTimingLimits fdcan = {512, 256, 128, 128};
constexpr BitTimingLimits sja1000 = {64, 16, 8, 4};     // clock: half of the crystal's frequency
constexpr BitTimingLimits mcp2515 = {64, 16, 8, 4, 2};  // likewise
constexpr BitTimingLimits mcp251xfd = {256, 256, 128, 128};

struct KnownTiming {
  const char* source;
  std::uint32_t clock;
  std::uint32_t rate;
  BitTimingLimits limits;
  BitTiming timing;       // prescaler, segment 1, segment 2, jump
  unsigned sample_point;  // 0.01 %
};

// Bit timings of application notes and of tables in use.
const KnownTiming known_timings[] = {
    {"8 MHz, as in CiA's table of recommended timings", 8000000, 10000, sja1000, {50, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 20000, sja1000, {25, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 50000, sja1000, {10, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 125000, sja1000, {4, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 250000, sja1000, {2, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 500000, sja1000, {1, 13, 2, 2}, 8750},
    {"8 MHz", 8000000, 800000, sja1000, {1, 8, 1, 1}, 9000},
    {"8 MHz", 8000000, 1000000, sja1000, {1, 6, 1, 1}, 8750},
    {"24 MHz, ZynqMP", 24000000, 10000, zynqmp, {150, 13, 2, 2}, 8750},
    {"24 MHz, ZynqMP", 24000000, 500000, zynqmp, {3, 13, 2, 2}, 8750},
    {"24 MHz, ZynqMP", 24000000, 800000, zynqmp, {2, 12, 2, 2}, 8666},
    {"24 MHz, ZynqMP", 24000000, 1000000, zynqmp, {3, 6, 1, 1}, 8750},
    {"36 MHz, STM32F1", 36000000, 125000, bxcan, {18, 13, 2, 2}, 8750},
    {"36 MHz, STM32F1", 36000000, 250000, bxcan, {9, 13, 2, 2}, 8750},
    {"36 MHz, STM32F1", 36000000, 1000000, bxcan, {2, 15, 2, 2}, 8888},
    {"42 MHz, STM32F4", 42000000, 500000, bxcan, {6, 11, 2, 2}, 8571},
    {"42 MHz, STM32F4", 42000000, 1000000, bxcan, {3, 11, 2, 2}, 8571},
    {"48 MHz, STM32F0", 48000000, 500000, bxcan, {6, 13, 2, 2}, 8750},
    {"80 MHz, FDCAN, all quanta of one period", 80000000, 1000000, fdcan, {1, 69, 10, 10}, 8750},
    {"80 MHz, FDCAN, segment 1 is limited", 80000000, 250000, fdcan, {2, 139, 20, 20}, 8750},
    {"16 MHz, MCP2515", 8000000, 1000000, mcp2515, {1, 5, 2, 2}, 7500},
    {"40 MHz, MCP2518FD", 40000000, 500000, mcp251xfd, {1, 69, 10, 10}, 8750},
};

std::string text(const BitTiming& timing) {
  return std::to_string(timing.prescaler) + " x (1 + " + std::to_string(timing.segment1) + " + " +
         std::to_string(timing.segment2) + "), jump " + std::to_string(timing.jump);
}

// Returns true if the timing is within the limits of the controller and has at least 8 quanta.
bool fits(const BitTiming& timing, const BitTimingLimits& limits) {
  return timing.prescaler >= 1 && timing.prescaler <= limits.prescaler && timing.segment1 >= 1 &&
         timing.segment1 <= limits.segment1 && timing.segment2 >= limits.segment2_from &&
         timing.segment2 <= limits.segment2 && timing.jump >= 1 && timing.jump <= limits.jump &&
         timing.jump <= timing.segment2 && timing.quanta() >= 8;
}

}  // namespace

TEST_CASE("bit timing: the results are those of application notes and of tables in use [301]") {
  for (const KnownTiming& row : known_timings) {
    CAPTURE(row.source);
    CAPTURE(row.rate);
    const BitTiming timing = co::find_bit_timing(row.clock, row.rate, row.limits);
    CHECK(text(timing) == text(row.timing));
    CHECK(timing.sample_point() == row.sample_point);
    CHECK(timing.rate(row.clock) == row.rate);
  }
}

TEST_CASE("bit timing: each result is within the limits of the controller and CiA's tolerances [301]") {
  unsigned found = 0;
  for (const BitTimingLimits& limits : {zynqmp, bxcan, fdcan, sja1000, mcp2515, mcp251xfd}) {
    for (std::uint32_t clock = 4000000; clock <= 120000000; clock += 333000 * test::stride(7)) {
      for (const std::uint32_t rate : co::cia_bit_rates) {
        const BitTiming timing = co::find_bit_timing(clock, rate, limits);
        if (timing.prescaler == 0) {
          continue;
        }
        ++found;
        const double exact = static_cast<double>(clock) / (timing.prescaler * timing.quanta());
        const bool good = fits(timing, limits) && exact > rate * 0.9989 && exact < rate * 1.0011 &&
                          timing.sample_point() >= (rate >= 800000 ? 7500 : 8500) && timing.sample_point() <= 9000;
        CHECK_MESSAGE(good, clock, " Hz, ", rate, " bit/s: ", text(timing));
      }
    }
  }
  CHECK(found > 2000 / test::stride(7));
}

// Compares the result with all possible bit timings.
TEST_CASE("bit timing: no other timing has a smaller error of the rate or with the same error a better sample point") {
  for (const std::uint32_t clock : {8000000U, 13560000U, 24000000U, 33333333U, 48000000U, 99999001U}) {
    for (const std::uint32_t rate : co::cia_bit_rates) {
      const BitTiming timing = co::find_bit_timing(clock, rate, zynqmp);
      const auto rate_error = [&](unsigned periods) {
        const double error = static_cast<double>(clock) / periods / rate - 1;
        return error < 0 ? -error : error;
      };
      const auto sample_point_error = [](const BitTiming& t) {  // distance to 87.5 %
        return t.sample_point() > 8750 ? t.sample_point() - 8750 : 8750 - t.sample_point();
      };
      for (std::uint16_t prescaler = 1; prescaler <= 256; ++prescaler) {
        for (std::uint16_t segment1 = 1; segment1 <= 16; ++segment1) {
          for (std::uint16_t segment2 = 1; segment2 <= 8; ++segment2) {
            const BitTiming other = {prescaler, segment1, segment2, 1};
            const unsigned earliest = rate >= 800000 ? 7500 : 8500;
            const bool allowed = other.quanta() >= 8 && other.sample_point() >= earliest &&
                                 other.sample_point() <= 9000 && rate_error(prescaler * other.quanta()) <= 0.00099;
            if (!allowed) {
              continue;
            }
            const double error = timing.prescaler == 0 ? 1 : rate_error(timing.prescaler * timing.quanta());
            const double other_error = rate_error(prescaler * other.quanta());
            const bool better = other_error < error - 1e-9 ||
                                (other_error < error + 1e-9 && sample_point_error(other) < sample_point_error(timing));
            if (better) {
              FAIL_CHECK(clock << " Hz, " << rate << " bit/s: " << text(other) << " is better than " << text(timing));
            }
          }
        }
      }
    }
  }
}

TEST_CASE("bit timing: an impossible rate gives prescaler 0") {
  CHECK(co::find_bit_timing(100000000, 10000, zynqmp).prescaler == 0);   // rate too low
  CHECK(co::find_bit_timing(100000000, 800000, zynqmp).prescaler == 0);  // 125 = 5 x 25 quanta: sample point at 68 %
  CHECK(co::find_bit_timing(4000000, 1000000, zynqmp).prescaler == 0);   // only 4 quanta
  CHECK(co::find_bit_timing(7000000, 500000, {256, 16, 8, 4, 1, 0}).prescaler == 1);
  CHECK(co::find_bit_timing(7000001, 500000, {256, 16, 8, 4, 1, 0}).prescaler == 0);  // deviation of 0 ppm required
  CHECK(co::find_bit_timing(4000000, 500000, mcp2515).prescaler == 0);                // 8 quanta: sample point at 75 %
  CHECK(co::find_bit_timing(0, 500000, zynqmp).prescaler == 0);
  CHECK(co::find_bit_timing(8000000, 0, zynqmp).prescaler == 0);
}

TEST_CASE("bit timing: timings and tables for drivers are constant expressions") {
  constexpr BitTiming timing = co::bit_timing<24000000, 500000, co::zynqmp_limits>;
  static_assert(timing.prescaler == 3 && timing.quanta() == 16 && timing.sample_point() == 8750);
  static constexpr auto& rates = co::zynqmp_rates<24000000, 125000, 1000000>;
  static_assert(rates.size() == 2 && rates[0].Baud == 125000 && rates[0].Prescaler == 11 && rates[0].Timing == 0x9C);
  static_assert(rates[1].Baud == 1000000 && rates[1].Prescaler == 2 && rates[1].Timing == 0x05);
}

TEST_CASE("bit timing: the macros for C give the same result") {
  constexpr CO_CAN_ZYNQMP_RATE by_macro[] = {
      CO_CAN_ZYNQMP_RATE_OF(24000000, 10000, 16),  CO_CAN_ZYNQMP_RATE_OF(24000000, 20000, 16),
      CO_CAN_ZYNQMP_RATE_OF(24000000, 50000, 16),  CO_CAN_ZYNQMP_RATE_OF(24000000, 125000, 16),
      CO_CAN_ZYNQMP_RATE_OF(24000000, 250000, 16), CO_CAN_ZYNQMP_RATE_OF(24000000, 500000, 16),
      CO_CAN_ZYNQMP_RATE_OF(24000000, 800000, 15), CO_CAN_ZYNQMP_RATE_OF(24000000, 1000000, 8),
  };
  constexpr auto& rates = co::zynqmp_rates<24000000, 10000, 20000, 50000, 125000, 250000, 500000, 800000, 1000000>;
  for (std::size_t n = 0; n < rates.size(); ++n) {
    CHECK(by_macro[n].Baud == rates[n].Baud);
    CHECK(by_macro[n].Prescaler == rates[n].Prescaler);
    CHECK(by_macro[n].Timing == rates[n].Timing);
  }
  CHECK(CO_CAN_ZYNQMP_RATE_FITS(24000000, 500000, 16));
  CHECK(CO_CAN_ZYNQMP_RATE_FITS(100000000, 20000, 20));
  CHECK_FALSE(CO_CAN_ZYNQMP_RATE_FITS(24000000, 500000, 12));   // sample point at 83 %
  CHECK_FALSE(CO_CAN_ZYNQMP_RATE_FITS(24000000, 500000, 21));   // segment 1 has 17 quanta
  CHECK_FALSE(CO_CAN_ZYNQMP_RATE_FITS(24000000, 1000000, 16));  // not a multiple
  CHECK_FALSE(CO_CAN_ZYNQMP_RATE_FITS(4000000, 1000000, 8));    // clock too slow
  CHECK_FALSE(CO_CAN_ZYNQMP_RATE_FITS(100000000, 10000, 20));   // prescaler 500
}
