// SPDX-License-Identifier: Apache-2.0
#include "support/timers.hpp"

namespace {

using namespace test;

CO_TMR with_frequency(std::uint32_t frequency) {
  CO_TMR tmr{};
  tmr.Freq = frequency;
  return tmr;
}

TEST_CASE("timer: time is converted to ticks exactly, rounded up, at any frequency") {
  struct Row {
    std::uint32_t frequency;
    std::uint16_t time;
    std::uint32_t unit;
    std::uint32_t ticks;
  };
  const Row rows[] = {
      {1000, 1, CO_TMR_UNIT_1MS, 1},
      {1000, 65535, CO_TMR_UNIT_1MS, 65535},
      {300, 1000, CO_TMR_UNIT_1MS, 300},
      {300, 1, CO_TMR_UNIT_1MS, 1},
      {300, 10, CO_TMR_UNIT_1MS, 3},
      {300, 11, CO_TMR_UNIT_1MS, 4},
      {1500, 1000, CO_TMR_UNIT_1MS, 1500},
      {1500, 1, CO_TMR_UNIT_1MS, 2},
      {1024, 1000, CO_TMR_UNIT_1MS, 1024},
      {1024, 1, CO_TMR_UNIT_1MS, 2},
      {1024, 125, CO_TMR_UNIT_1MS, 128},
      {32768, 1, CO_TMR_UNIT_1MS, 33},
      {32768, 1000, CO_TMR_UNIT_1MS, 32768},
      {72000000, 59000, CO_TMR_UNIT_1MS, 4248000000},
      {72000000, 59652, CO_TMR_UNIT_1MS, 4294944000},
      {72000000, 59653, CO_TMR_UNIT_1MS, 0},
      {72000000, 65535, CO_TMR_UNIT_1MS, 0},
      {1000, 1, CO_TMR_UNIT_100US, 1},
      {1000, 10, CO_TMR_UNIT_100US, 1},
      {1000, 11, CO_TMR_UNIT_100US, 2},
      {1000000, 3, CO_TMR_UNIT_100US, 300},
      {1, 1, CO_TMR_UNIT_1MS, 1},
      {1000, 0, CO_TMR_UNIT_1MS, 0},
      {0, 10, CO_TMR_UNIT_1MS, 0},
      {1000, 10, 0, 0},
      {4294967295, 1, 1, 4294967295},
      {4294967295, 1000, CO_TMR_UNIT_1MS, 4294967295},
      {4294967295, 1001, CO_TMR_UNIT_1MS, 0},
  };
  for (const Row& row : rows) {
    CAPTURE(row.frequency);
    CAPTURE(row.time);
    CAPTURE(row.unit);
    CO_TMR tmr = with_frequency(row.frequency);
    CHECK(COTmrGetTicks(&tmr, row.time, row.unit) == row.ticks);
  }
}

TEST_CASE("timer: COTmrGetMinTime returns the shortest time of a tick in the unit") {
  const auto shortest = [](std::uint32_t frequency, std::uint32_t unit) {
    CO_TMR tmr = with_frequency(frequency);
    return COTmrGetMinTime(&tmr, unit);
  };
  CHECK(shortest(1000, CO_TMR_UNIT_1MS) == 1);
  CHECK(shortest(1000000, CO_TMR_UNIT_1MS) == 1);
  CHECK(shortest(300, CO_TMR_UNIT_1MS) == 4);
  CHECK(shortest(10, CO_TMR_UNIT_1MS) == 100);
  CHECK(shortest(1000, CO_TMR_UNIT_100US) == 10);
  CHECK(shortest(0, CO_TMR_UNIT_1MS) == 0);
  CHECK(shortest(1000, 0) == 0);
  CHECK(shortest(1, 65535) == 65535);
  CHECK(shortest(1, 65536) == 0);
}

}  // namespace
