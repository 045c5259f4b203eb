// SPDX-License-Identifier: Apache-2.0
// Tests SDO transfers between a Lexican client and a Lexican server: one fault at every position of every transfer.
// [T11]
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "support/sdo_pair_faults.hpp"
#include "support/stride.hpp"

#if USE_CSDO

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::all_faults;
using test::both_directions;
using test::Direction;
using test::FaultyTransfer;
using test::frame_faults;
using test::FrameFault;
using test::Milliseconds;
using test::SdoPair;
using Fault = VirtualBus::Fault;

// A transfer that knows which of its frames may be lost without an abort.
class Course {
 public:
  Course(std::uint32_t bytes, bool block)
      : segments_((bytes + 6) / 7),
        blocks_(USE_CSDO_BLOCK != 0 && block && bytes >= CO_CSDO_BLOCK),
        pair_({bytes, block}) {}

  // Disturbs every \a stride-th position, the first and the last ones. \a in_turn: one kind of fault for each, else
  // all.
  void run(Direction direction, std::uint32_t stride, bool in_turn) {
    frames_ = pair_.count_frames(direction);
    for (std::uint32_t position = 1; position <= frames_; ++position) {
      if (position <= 5 || position + 5 > frames_ || position % stride == 0) {
        CAPTURE(position);
        disturb_at(direction, position, in_turn);
      }
    }
  }

 private:
  void disturb_at(Direction direction, std::uint32_t position, bool in_turn) {
    for (std::size_t n = 0; n < std::size(frame_faults); ++n) {
      if (in_turn && position % std::size(frame_faults) != n) {
        continue;
      }
      CAPTURE(n);
      const FaultyTransfer result = test::disturb(pair_, direction, {{frame_faults[n], position}});
      REQUIRE(result.all_applied);
      if (frame_faults[n].kind == Fault::drop && is_repeated(direction, position)) {
        REQUIRE(result.code == 0);
      }
    }
  }

  // Returns true if a lost frame is repeated: all frames within the blocks are, but not those that begin the transfer,
  // or end it after the last segment. [D11] [D12] Nor is the only segment of a last block: after a repeated acknowledge
  // before it, the receiver cannot detect that there was one. In blocks of one segment that is true of each.
  bool is_repeated(Direction direction, std::uint32_t position) const {
    const std::uint32_t blksize = direction == Direction::download ? CO_SDO_BUF_SEG : 127;
    const std::uint32_t last_segment = frames_ - 3;
    const std::uint32_t first = direction == Direction::download ? 2 : 4;
    const std::uint32_t last = direction == Direction::download ? last_segment + 1 : last_segment;
    const bool alone = blksize == 1 || ((segments_ - 1) % blksize == 0 && position == last_segment);
    return blocks_ && position >= first && position <= last && !alone;
  }

  std::uint32_t segments_;
  bool blocks_;
  std::uint32_t frames_ = 0;
  SdoPair pair_;
};

// Disturbs transfers of a client whose time-out is longer than that of the server.
void run_patiently(Direction direction, std::uint32_t bytes, bool block) {
  SdoPair pair({bytes, block});
  const std::uint32_t frames = pair.count_frames(direction);
  for (std::uint32_t position = 1; position <= frames; ++position) {
    for (const FrameFault& fault : frame_faults) {
      CAPTURE(position);
      CAPTURE(fault.kind);
      CAPTURE(fault.delay.count());
      REQUIRE(test::disturb(pair, direction, {{fault, position}}, 5000ms).all_applied);
    }
  }
}

// Starts the next transfer in the callback of the disturbed one.
void run_hastily(SdoPair& pair, Direction direction, const FrameFault& fault, std::uint32_t position) {
  std::string wrong = "no callback";
  pair.line.bus.add_rule({fault.kind, {}, position, 1, fault.delay});
  pair.device_client().on_end = [&] {
    pair.device_client().on_end = nullptr;
    wrong = pair.wrong();
    pair.start(direction, SdoPair::short_object);
  };
  pair.start(direction);
  pair.finish(2500ms);
  REQUIRE(wrong == "");
  if (fault.kind == Fault::drop) {
    REQUIRE(pair.device_client().code == 0);
  }
  pair.line.bus.clear_rules();
  REQUIRE(pair.becomes_idle(fault.delay + 2100ms));
  pair.check_next();
}

void run_courses(Direction direction, bool block) {
  for (const std::uint32_t bytes : {1u, 7u, 8u, 28u, 29u, 888u, 889u, 890u, 891u, 897u, 1800u, 2000u}) {
    CAPTURE(bytes);
    Course(bytes, block).run(direction, test::stride(3), bytes > 100 && !block && !all_faults());
  }
}

}  // namespace

TEST_CASE(
    "SDO faults: a block upload with one frame lost, doubled, late or swapped gives the right data or none [T11]") {
  run_courses(Direction::upload, true);
}

TEST_CASE("SDO faults: a block download with one frame lost, doubled, late or swapped is right or reported [T11]") {
  run_courses(Direction::download, true);
}

TEST_CASE(
    "SDO faults: a segmented upload with one frame lost, doubled, late or swapped gives right data or none [T11]") {
  run_courses(Direction::upload, false);
}

TEST_CASE("SDO faults: a segmented download with one frame lost, doubled, late or swapped is right or reported [T11]") {
  run_courses(Direction::download, false);
}

TEST_CASE("SDO faults: without a fault every size up to 2000 bytes (without blocks: 300) is transferred") {
  for (const bool block : {true, false}) {
    SdoPair pair({1, block});
    for (std::uint32_t bytes = 1; bytes <= (block ? 2000 : 300); ++bytes) {
      CAPTURE(block);
      CAPTURE(bytes);
      pair.server.resize(SdoPair::object, bytes);
      REQUIRE(pair.run(Direction::upload) == 0);
      REQUIRE(pair.run(Direction::download) == 0);
    }
  }
}

TEST_CASE("SDO faults: one frame lost, doubled, late or swapped, and the server has the shorter time-out [T11] [D18]") {
  for (const std::uint32_t bytes : {1u, 8u, 28u, 29u, 224u}) {
    for (const Direction direction : both_directions) {
      CAPTURE(bytes);
      run_patiently(direction, bytes, true);
      run_patiently(direction, bytes, false);
    }
  }
}

TEST_CASE("SDO faults: the callback of a disturbed transfer starts the next one [T11]") {
  for (const std::uint32_t bytes : {4u, 28u, 224u}) {
    SdoPair pair({bytes});
    for (const Direction direction : both_directions) {
      const std::uint32_t frames = pair.count_frames(direction);
      for (std::uint32_t position = 1; position <= frames; ++position) {
        for (const FrameFault& fault : frame_faults) {
          CAPTURE(bytes);
          CAPTURE(position);
          CAPTURE(fault.kind);
          CAPTURE(fault.delay.count());
          run_hastily(pair, direction, fault, position);
        }
      }
    }
  }
}

TEST_CASE("SDO faults: 65536 bytes, some frames (LEXICAN_SDO_FAULTS=all: each) lost, doubled, late or swapped [T11]") {
  for (const bool block : {true, false}) {
    CAPTURE(block);
    Course course(65536, block);
    for (const Direction direction : both_directions) {
      course.run(direction, all_faults() ? 1 : 1511, !all_faults() || !block);
    }
  }
}

#endif
