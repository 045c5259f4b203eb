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

enum class FaultsAtPosition { all, one_in_turn };  // every kind of fault, or one kind, which alternates

// Transfers of one object with a fault. Checks that transfers succeed whose lost frame has to be repeated.
class DisturbedTransfer {
 public:
  DisturbedTransfer(std::uint32_t bytes, bool block)
      : segments_((bytes + 6) / 7),
        blocks_(CO_CSDO_BLOCK != 0 && block && bytes + 1 > CO_CSDO_BLOCK),
        pair_({bytes, block}) {}

  // Runs transfers with a fault at every \a stride-th frame, at the first five and at the last five frames.
  void run(Direction direction, std::uint32_t stride, FaultsAtPosition faults) {
    frames_ = pair_.count_frames(direction);
    for (std::uint32_t position = 1; position <= frames_; ++position) {
      if (position <= 5 || position + 5 > frames_ || position % stride == 0) {
        CAPTURE(position);
        disturb_at(direction, position, faults);
      }
    }
  }

 private:
  void disturb_at(Direction direction, std::uint32_t position, FaultsAtPosition faults) {
    for (std::size_t n = 0; n < std::size(frame_faults); ++n) {
      if (faults == FaultsAtPosition::one_in_turn && position % std::size(frame_faults) != n) {
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

  // Returns true if a lost frame has to be repeated: every frame within the blocks, but not those that begin the
  // transfer or end it after the last segment. [D11] [D12] The only segment of a block is not repeated either: if it is
  // lost, the receiver repeats the previous acknowledge, and the sender cannot detect the loss.
  bool is_repeated(Direction direction, std::uint32_t position) const {
    const std::uint32_t blksize = direction == Direction::download ? CO_SDO_BUF_SEG : 127;
    const std::uint32_t last_segment = frames_ - 3;
    const std::uint32_t first = direction == Direction::download ? 2 : 4;
    const std::uint32_t last = direction == Direction::download ? last_segment + 1 : last_segment;
    const bool is_only_segment = blksize == 1 || ((segments_ - 1) % blksize == 0 && position == last_segment);
    return blocks_ && position >= first && position <= last && !is_only_segment;
  }

  std::uint32_t segments_;
  bool blocks_;
  std::uint32_t frames_ = 0;
  SdoPair pair_;
};

// Runs transfers with each fault at each frame. The client's time-out is longer than that of the server.
void run_with_longer_client_time_out(Direction direction, std::uint32_t bytes, bool block) {
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

// Runs a transfer with a fault, and starts the next transfer in its callback.
void run_with_restart_in_callback(SdoPair& pair, Direction direction, const FrameFault& fault, std::uint32_t position) {
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

void disturb_all_sizes(Direction direction, bool block) {
  for (const std::uint32_t bytes : {1u, 7u, 8u, 28u, 29u, 888u, 889u, 890u, 891u, 897u, 1800u, 2000u}) {
    CAPTURE(bytes);
    DisturbedTransfer(bytes, block)
        .run(direction, test::stride(3),
             bytes > 100 && !block && !all_faults() ? FaultsAtPosition::one_in_turn : FaultsAtPosition::all);
  }
}

}  // namespace

TEST_CASE("SDO faults: a block upload with one frame lost/doubled/late/swapped gives the right data or none [T11]") {
  disturb_all_sizes(Direction::upload, true);
}

TEST_CASE(
    "SDO faults: a block download with one frame lost/doubled/late/swapped is correct or reports a failure [T11]") {
  disturb_all_sizes(Direction::download, true);
}

TEST_CASE(
    "SDO faults: a segmented upload with one frame lost/doubled/late/swapped gives the right data or none [T11]") {
  disturb_all_sizes(Direction::upload, false);
}

TEST_CASE(
    "SDO faults: a segmented download with one frame lost/doubled/late/swapped is correct or reports a failure [T11]") {
  disturb_all_sizes(Direction::download, false);
}

TEST_CASE("SDO faults: without a fault every size is transferred up to 2000 bytes by block and 300 by segments") {
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

TEST_CASE("SDO faults: one fault gives no wrong data if the server has the shorter time-out [T11] [D18]") {
  for (const std::uint32_t bytes : {1u, 8u, 28u, 29u, 224u}) {
    for (const Direction direction : both_directions) {
      CAPTURE(bytes);
      run_with_longer_client_time_out(direction, bytes, true);
      run_with_longer_client_time_out(direction, bytes, false);
    }
  }
}

TEST_CASE("SDO faults: a transfer that is started in the callback of a disturbed one is correct [T11]") {
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
          run_with_restart_in_callback(pair, direction, fault, position);
        }
      }
    }
  }
}

TEST_CASE("SDO faults: a transfer of 65536 bytes with a fault at some frame is correct or reports a failure [T11]") {
  for (const bool block : {true, false}) {
    CAPTURE(block);
    DisturbedTransfer transfer(65536, block);
    for (const Direction direction : both_directions) {
      transfer.run(direction, all_faults() ? 31 : 1511,
                   !all_faults() || !block ? FaultsAtPosition::one_in_turn : FaultsAtPosition::all);
    }
  }
}

#endif
