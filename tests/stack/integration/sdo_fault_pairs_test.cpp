// SPDX-License-Identifier: Apache-2.0
// Tests SDO transfers between a Lexican client and server: two faults at every pair of positions, and three. [T11]
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "support/sdo_pair_faults.hpp"
#include "support/stride.hpp"

#if USE_CSDO

namespace {

using test::all_faults;
using test::both_directions;
using test::Direction;
using test::FaultsAtFrames;
using test::FaultyTransfer;
using test::frame_faults;
using test::FrameFault;
using test::SdoPair;

// Transfers with two faults, each of the first \a kinds. The first fault determines how many positions there are for
// the second.
class Pairs {
 public:
  Pairs(std::uint32_t bytes, bool block, std::size_t kinds) : pair_({bytes, block}), kinds_(kinds) {}

  // Places both faults at every \a stride-th position.
  void run(Direction direction, std::uint32_t stride = 1) {
    const std::uint32_t frames = pair_.count_frames(direction);
    for (std::uint32_t position = 1; position <= frames; position += stride) {
      for (std::size_t kind = 0; kind < kinds_; ++kind) {
        CAPTURE(position);
        CAPTURE(kind);
        run_second(direction, {{frame_faults[kind], position}}, stride);
      }
    }
  }

 private:
  void run_second(Direction direction, const FaultsAtFrames& first, std::uint32_t stride) {
    const FaultyTransfer alone = test::disturb(pair_, direction, first);
    REQUIRE(alone.all_applied);
    for (std::uint32_t position = first[0].position + 1; position <= alone.frames; position += stride) {
      for (std::size_t kind = 0; kind < kinds_; ++kind) {
        CAPTURE(position);
        CAPTURE(kind);
        REQUIRE(test::disturb(pair_, direction, {first[0], {frame_faults[kind], position}}).all_applied);
      }
    }
  }

  SdoPair pair_;
  std::size_t kinds_;
};

// Runs \a rounds transfers with three faults each within their first 300 frames.
void run_triples(unsigned rounds, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
  SdoPair pair({2000});
  for (unsigned round = 0; round < rounds; ++round) {
    const std::uint32_t bytes = 29 + below(2000 - 29);
    FaultsAtFrames faults;
    for (unsigned n = 0; n < 3; ++n) {
      faults.push_back({frame_faults[below(std::size(frame_faults))], 1 + below(bytes / 7 + 9)});
    }
    CAPTURE(round);
    pair.server.resize(SdoPair::object, bytes);
    test::disturb(pair, below(2) == 0 ? Direction::upload : Direction::download, faults);
  }
}

constexpr std::size_t all_kinds = std::size(frame_faults);
constexpr std::size_t first_kinds = 3;  // lost, duplicated, swapped

}  // namespace

TEST_CASE("SDO faults: every pair of faults in short transfers gives the right data or a report [T11]") {
  for (const std::uint32_t bytes : {1u, 7u, 8u, 28u, 29u}) {
    for (const Direction direction : both_directions) {
      CAPTURE(bytes);
      Pairs(bytes, true, all_kinds).run(direction);
    }
  }
}

TEST_CASE("SDO faults: every pair of frames of 32 segments lost, doubled or swapped [T11]") {
  for (const Direction direction : both_directions) {
    Pairs(32 * 7, true, all_faults() ? all_kinds : first_kinds).run(direction, test::stride(3));
  }
}

TEST_CASE("SDO faults: every pair of faults in 12 (LEXICAN_SDO_FAULTS=all: 32) segments without blocks [T11]") {
  for (const Direction direction : both_directions) {
    Pairs((all_faults() ? 32 : 12) * 7, false, all_faults() ? all_kinds : first_kinds).run(direction);
  }
}

TEST_CASE("SDO faults: three random faults (LEXICAN_SDO_FAULTS=all: more often) [T11]") {
  run_triples(all_faults() ? 50000 : 2000, 301);
}

TEST_CASE("SDO faults: pairs of faults in three blocks (LEXICAN_SDO_FAULTS=all: at more positions) [T11]") {
  for (const Direction direction : both_directions) {
    Pairs(2000, true, all_faults() ? all_kinds : first_kinds).run(direction, all_faults() ? 7 : 23);
  }
}

#endif
