// SPDX-License-Identifier: Apache-2.0
// The acceptance filters and bit rates of drivers/can/bxcan, drivers/can/fdcan and drivers/can/flexcan.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "bxcan_filters.hpp"
#include "bxcan_rates.hpp"
#include "co_can_bxcan.h"
#include "co_can_fdcan.h"
#include "co_can_flexcan.h"
#include "fdcan_filters.hpp"
#include "fdcan_rates.hpp"
#include "flexcan_filters.hpp"
#include "flexcan_rates.hpp"

namespace {

using Ids = std::vector<std::uint32_t>;

constexpr unsigned filters_of_14_banks = 26;

// Returns the bits of an identifier that a filter of bxCAN with 16 bits compares: those of a data frame.
std::uint16_t bxcan_word(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return static_cast<std::uint16_t>((identifier & CO_IF_FRM_EXT) == 0 ? id << 5 : (id >> 18 << 5) | 8 | (id >> 15 & 7));
}

bool passes(const co::bxcan::Filters& all, std::uint32_t identifier) {
  return std::any_of(all.filter, all.filter + all.number, [identifier](const co::bxcan::Filter& filter) {
    const auto matches = [&filter](unsigned word) { return ((word ^ filter.word) & filter.mask) == 0; };
    const std::uint16_t data = bxcan_word(identifier);
    return matches(data) && matches(data | 0x10U);
  });
}

// Returns the bits of an identifier that the receive FIFO of FlexCAN compares.
std::uint32_t flexcan_word(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return (identifier & CO_IF_FRM_EXT) == 0 ? id << 19 : 0x40000000 | id << 1;
}

bool passes(const co::flexcan::Filters& all, std::uint32_t identifier) {
  return std::any_of(all.filter, all.filter + all.number, [identifier](const co::flexcan::Filter& filter) {
    return ((flexcan_word(identifier) ^ filter.word) & filter.mask) == 0;
  });
}

template <typename Ranges>
bool within(const Ranges& ranges, std::uint32_t id) {
  return std::any_of(ranges.range, ranges.range + ranges.number,
                     [id](const auto& range) { return range.first <= id && id <= range.last; });
}

bool passes(const co::fdcan::Filters& all, std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return (identifier & CO_IF_FRM_EXT) != 0 ? within(all.extended, id) : within(all.standard, id);
}

template <typename Filters>
unsigned number_of_base_ids(const Filters& all) {
  unsigned number = 0;
  for (std::uint32_t id = 0; id < 0x800; ++id) {
    number += passes(all, id) ? 1U : 0U;
  }
  return number;
}

// Identifiers of a node with 40 heartbeat consumers.
Ids ids_of_a_large_node() {
  Ids ids = {0x000, 0x080, 0x100, 0x205, 0x305, 0x405, 0x505, 0x605, 0x605};
  for (std::uint32_t node = 1; node <= 40; ++node) {
    ids.push_back(0x700 + node);
  }
  ids.push_back(0x7E5);
  return ids;
}

TEST_CASE("bxCAN, M_CAN: the filters pass exactly the identifiers of a usual node") {
  const Ids ids = {0x000, 0x080, 0x080, 0x100, 0x185, 0x205, 0x305, 0x405, 0x505, 0x605, 0x701, 0x702, 0x7E5};
  const auto bxcan = co::bxcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()), filters_of_14_banks);
  const auto fdcan = co::fdcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()));
  for (const std::uint32_t id : ids) {
    CAPTURE(id);
    CHECK(passes(bxcan, id));
    CHECK(passes(fdcan, id));
  }
  CHECK(number_of_base_ids(bxcan) == ids.size() - 1);
  CHECK(number_of_base_ids(fdcan) == ids.size() - 1);
  CHECK(!passes(bxcan, CO_IF_FRM_EXT | 0x80));
  CHECK(!passes(fdcan, CO_IF_FRM_EXT | 0x80));
}

constexpr co::flexcan::Capacity flexcan_fifo = {24, 12};  // of a controller with 16 message buffers
constexpr co::flexcan::Capacity flexcan_mailboxes = {14, 14};

TEST_CASE("FlexCAN: the filters pass exactly the identifiers of a usual node and few others of a large node") {
  const Ids ids = {0x000, 0x080, 0x080, 0x100, 0x185, 0x205, 0x305, 0x405, 0x505, 0x605, 0x701, 0x702, 0x7E5};
  for (const co::flexcan::Capacity& capacity : {flexcan_fifo, flexcan_mailboxes}) {
    const auto flexcan = co::flexcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()), capacity);
    for (const std::uint32_t id : ids) {
      CAPTURE(id);
      CHECK(passes(flexcan, id));
    }
    CHECK(flexcan.number == ids.size() - 1);
    CHECK(number_of_base_ids(flexcan) == ids.size() - 1);
    CHECK(!passes(flexcan, CO_IF_FRM_EXT | 0x80));
  }
  const Ids large = ids_of_a_large_node();
  const auto fifo = co::flexcan::filters_of(large.data(), static_cast<unsigned>(large.size()), flexcan_fifo);
  CHECK(number_of_base_ids(fifo) <= large.size() + 16);
  const auto mailboxes = co::flexcan::filters_of(large.data(), static_cast<unsigned>(large.size()), flexcan_mailboxes);
  CHECK(number_of_base_ids(mailboxes) <= large.size() + 64);
}

TEST_CASE("FlexCAN: any identifiers pass the filters that are computed from them, those without a mask are the last") {
  std::mt19937 random(1);
  for (unsigned round = 0; round < 200; ++round) {
    Ids ids(random() % 130);
    for (std::uint32_t& id : ids) {
      id = random() % 4 != 0 ? random() & 0x7FF : CO_IF_FRM_EXT | (random() & CO_IF_FRM_ID);
    }
    std::sort(ids.begin(), ids.end());
    const auto number = 2 + static_cast<unsigned>(random() % (co::flexcan::filters_at_most - 1));
    const co::flexcan::Capacity capacity = {number, 2 + static_cast<unsigned>(random() % (number - 1))};
    const auto all = co::flexcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()), capacity);
    REQUIRE(all.number <= capacity.number);
    for (unsigned n = capacity.masked; n < all.number; ++n) {
      REQUIRE(all.filter[n].mask == co::flexcan::standard_mask);
      REQUIRE((all.filter[n].word & ~co::flexcan::standard_mask) == 0);
      REQUIRE((all.filter[n].word & 0x40000000) == 0);
    }
    for (const std::uint32_t id : ids) {
      CAPTURE(id);
      REQUIRE(passes(all, id));
    }
  }
}

TEST_CASE("FlexCAN: the macros for C compute bit timings like the tables for C++") {
  constexpr CO_CAN_FLEXCAN_RATE rate = CO_CAN_FLEXCAN_RATE_OF(40000000, 500000, 16);
  static_assert(CO_CAN_FLEXCAN_RATE_FITS(40000000, 500000, 16) && !CO_CAN_FLEXCAN_RATE_FITS(40000000, 500000, 12));
  static_assert(CO_CAN_FLEXCAN_RATE_FITS(8000000, 1000000, 8) && !CO_CAN_FLEXCAN_RATE_FITS(8000000, 500000, 21));
  CHECK(rate.Timing == 0x04610007);  // prescaler 5, segments 8 + 5 and 2, jump 2
  CHECK(rate.Wide == 0);
  CHECK(co::flexcan_rates<40000000, 500000>[0].Timing == 0x04610007);
  constexpr CO_CAN_FLEXCAN_RATE shortest = CO_CAN_FLEXCAN_RATE_OF(8000000, 1000000, 8);
  CHECK(shortest.Timing == 0x00490002);  // prescaler 1, segments 3 + 2 and 2, jump 2
  CHECK(co::flexcan_rates<8000000, 1000000>[0].Timing == 0x00490002);
  CHECK(co::flexcan_wide_rates<80000000, 500000>[0].Wide ==
        0x8029E929);  // prescaler 2, segments 59 + 10 and 10, jump 10
}

TEST_CASE("bxCAN, M_CAN: if there are more identifiers than filters then few other identifiers pass") {
  const Ids ids = ids_of_a_large_node();
  const auto bxcan = co::bxcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()), filters_of_14_banks);
  const auto fdcan = co::fdcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()));
  CHECK(bxcan.number <= filters_of_14_banks);
  CHECK(number_of_base_ids(bxcan) <= ids.size() + 16);
  CHECK(number_of_base_ids(fdcan) == ids.size() - 1);
}

TEST_CASE("bxCAN, M_CAN: any identifiers pass the filters that are computed from them") {
  std::mt19937 random(1);
  for (unsigned round = 0; round < 200; ++round) {
    Ids ids(random() % 130);
    for (std::uint32_t& id : ids) {
      id = random() % 4 != 0 ? random() & 0x7FF : CO_IF_FRM_EXT | (random() & CO_IF_FRM_ID);
    }
    std::sort(ids.begin(), ids.end());
    const unsigned most = 1 + static_cast<unsigned>(random() % co::bxcan::filters_at_most);
    const auto bxcan = co::bxcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()), most);
    const auto fdcan = co::fdcan::filters_of(ids.data(), static_cast<unsigned>(ids.size()));
    REQUIRE(bxcan.number <= most);
    REQUIRE(fdcan.standard.number < co::fdcan::standard_filters);
    REQUIRE(fdcan.extended.number < co::fdcan::extended_filters);
    for (const std::uint32_t id : ids) {
      CAPTURE(id);
      REQUIRE(passes(bxcan, id));
      REQUIRE(passes(fdcan, id));
    }
  }
}

TEST_CASE("bxCAN, M_CAN: the macros for C compute bit timings like the tables for C++") {
  constexpr CO_CAN_BXCAN_RATE bxcan = CO_CAN_BXCAN_RATE_OF(36000000, 500000, 18);
  static_assert(CO_CAN_BXCAN_RATE_FITS(36000000, 500000, 18) && !CO_CAN_BXCAN_RATE_FITS(36000000, 500000, 16));
  CHECK(bxcan.Timing == 0x011E0003);  // prescaler 4, segments 15 and 2, jump 2
  CHECK(co::bxcan_rates<16000000, 500000>[0].Timing == 0x011C0001);
  constexpr CO_CAN_FDCAN_RATE fdcan = CO_CAN_FDCAN_RATE_OF(160000000, 500000, 160);
  static_assert(CO_CAN_FDCAN_RATE_FITS(160000000, 500000, 160) && !CO_CAN_FDCAN_RATE_FITS(170000000, 1000000, 160));
  CHECK(fdcan.Timing == 0x26018A13);  // prescaler 2, segments 139 and 20, jump 20
  CHECK(co::fdcan_rates<160000000, 500000>[0].Timing == 0x26018A13);
  for (const std::uint32_t baud : co::cia_bit_rates) {  // the table of docs/drivers/fdcan.md
    CAPTURE(baud);
    const unsigned quanta_of_80_mhz = baud == 1000000 ? 80 : baud == 800000 ? 100 : 160;
    CHECK(CO_CAN_FDCAN_RATE_FITS(80000000U, baud, quanta_of_80_mhz));
    CHECK(CO_CAN_FDCAN_RATE_FITS(160000000U, baud, baud == 800000 ? 200U : 160U));
    CHECK(CO_CAN_FDCAN_RATE_FITS(170000000U, baud, 170U) == (baud != 800000));
  }
  CHECK(co::find_bit_timing(170000000, 800000, co::fdcan_limits).prescaler == 0);
}

}  // namespace
