// SPDX-License-Identifier: Apache-2.0
// Tests SDO transfers on a bus that loses, duplicates, delays and swaps frames: one fault at every position of every
// transfer.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <vector>

#include "support/network.hpp"
#include "support/raw_sdo_client.hpp"

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::Device;
using test::Line;
using test::RawSdoClient;
using test::SdoResult;
using test::World;
using Bytes = std::vector<std::uint8_t>;
using End = SdoResult::End;
using Fault = VirtualBus::Fault;

constexpr std::uint32_t sizes[] = {1, 7, 8, 14, 889, 4000};

struct Disturbance {
  const char* name;
  Fault fault;
  std::chrono::milliseconds delay;
  std::chrono::milliseconds client_time_out;  // the server's time-out is 2000 ms
};

constexpr Disturbance disturbances[] = {
    {"lost", Fault::drop, 0ms, 1000ms},
    {"lost, and the server's time-out comes first", Fault::drop, 0ms, 5000ms},
    {"doubled", Fault::duplicate, 0ms, 1000ms},
    {"delayed beyond the client's time-out", Fault::delay, 1500ms, 1000ms},
    {"delayed beyond the server's time-out", Fault::delay, 3000ms, 5000ms},
    {"swapped with the sender's next", Fault::reorder, 0ms, 1000ms},
};

enum class Direction { upload, download };

// Returns data without a period of 7, different for each seed.
Bytes pattern(std::uint32_t size, std::uint32_t seed) {
  Bytes bytes(size);
  std::uint32_t state = seed * 2654435761u + 1;
  for (std::uint8_t& byte : bytes) {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  return bytes;
}

class Bench {
 public:
  explicit Bench(std::uint32_t size) : size_(size) { line_.stop_recording(); }

  // Returns the number of frames of an undisturbed transfer.
  std::uint32_t measure(Direction direction) {
    const std::size_t rule = line_.bus.add_rule({Fault::none, {}, 1, VirtualBus::always});
    CHECK(transfer(direction, 0).is_done());
    const std::uint32_t frames = line_.bus.struck(rule);
    line_.bus.clear_rules();
    return frames;
  }

  void disturb(Direction direction, const Disturbance& disturbance, std::uint32_t position) {
    client_.set_time_out(disturbance.client_time_out);
    const std::size_t rule = line_.bus.add_rule({disturbance.fault, {}, position, 1, disturbance.delay});
    const SdoResult result = transfer(direction, position);
    REQUIRE(line_.bus.struck(rule) == 1);
    line_.bus.clear_rules();
    if (disturbance.fault == Fault::drop) {
      REQUIRE_FALSE(result.is_done());  // each frame of the transfer is needed
    }
    check_next_transfers(disturbance, position);
  }

 private:
  SdoResult transfer(Direction direction, std::uint32_t seed) {
    const Bytes data = pattern(size_, seed);
    if (direction == Direction::upload) {
      device_.domain_bytes = data;
      const SdoResult result = client_.upload(0x2010, 0);
      REQUIRE((!result.is_done() || result.data == data));
      return result;
    }
    std::fill(device_.domain_bytes.begin(), device_.domain_bytes.end(), static_cast<std::uint8_t>(0));
    const SdoResult result = client_.download(0x2010, 0, data);
    REQUIRE((!result.is_done() || device_.domain_bytes == data));
    return result;
  }

  // Transfers again at once, and after every delayed frame has arrived.
  void check_next_transfers(const Disturbance& disturbance, std::uint32_t seed) {
    if (disturbance.fault == Fault::reorder) {
      client_.ask({0x40, 0x00, 0x20});  // releases a frame that is still held to be swapped
    }
    check_transfer(static_cast<std::uint8_t>(seed));
    if (disturbance.fault == Fault::delay) {
      world_.pass(disturbance.delay);
      check_transfer(static_cast<std::uint8_t>(seed + 1));
    }
  }

  void check_transfer(std::uint8_t seed) {
    const Bytes data = {seed, 2, 3, 4, 5, 6, 7, static_cast<std::uint8_t>(~seed)};
    REQUIRE(client_.download(0x2001, 0, data).is_done());
    REQUIRE(client_.upload(0x2001, 0).data == data);
    REQUIRE(client_.drain() == 0);
  }

  std::uint32_t size_;
  World world_;
  Line& line_ = world_.add_line("lossy");
  Device& device_ = world_.add_device(line_, {5, 0, size_});
  RawSdoClient client_{world_, line_, 5};
};

// Applies one of the disturbances (\a in_turn, for long transfers) or all of them at \a position.
void disturb_at(Bench& bench, Direction direction, std::uint32_t position, bool in_turn) {
  for (std::size_t n = 0; n < std::size(disturbances); ++n) {
    if (!in_turn || position % std::size(disturbances) == n) {
      CAPTURE(disturbances[n].name);
      bench.disturb(direction, disturbances[n], position);
    }
  }
}

void disturb_all(Direction direction) {
  for (const std::uint32_t size : sizes) {
    CAPTURE(size);
    Bench bench(size);
    const std::uint32_t frames = bench.measure(direction);
    const bool expedited = direction == Direction::upload && size <= 4;
    REQUIRE(frames == (expedited ? 2 : 2 + 2 * ((size + 6) / 7)));
    for (std::uint32_t position = 1; position <= frames; ++position) {
      CAPTURE(position);
      disturb_at(bench, direction, position, size > 1000);
    }
  }
}

}  // namespace

TEST_CASE("lossy bus: an upload with one frame lost, doubled, late or swapped gives the right data or none [T11]") {
  disturb_all(Direction::upload);
}

TEST_CASE("lossy bus: a download with one frame lost, doubled, late or swapped is right or not confirmed [T11]") {
  disturb_all(Direction::download);
}

TEST_CASE("lossy bus: the server aborts a transfer without a client once [D18]") {
  for (const char* const initiate : {"605#2110200010000000", "605#2010200000000000", "605#4010200000000000"}) {
    CAPTURE(initiate);
    World world;
    Line& line = world.add_line("lossy");
    world.add_device(line, {5});
    line.say(initiate);
    world.settle();
    line.take();
    world.pass(10s);
    CHECK(line.take_texts() == test::Texts{"585#8010200000000405"});
    line.say("605#6000000000000000");  // no transfer is open: the abort has the multiplexer of the frame
    world.settle();
    CHECK(line.take_texts() == test::Texts{"585#8000000001000405"});
  }
}

TEST_CASE("lossy bus: a segment repeated after a lost answer is written once") {
  World world;
  Line& line = world.add_line("lossy");
  Device& device = world.add_device(line, {5, 0, 14});
  line.take();
  for (const char* const frame : {"605#211020000E000000", "605#0001020304050607", "605#0001020304050607"}) {
    line.say(frame);
    world.settle();
  }
  CHECK(line.take_texts() == test::Texts{"585#6010200000000000", "585#2000000000000000", "585#8010200000000305"});
  CHECK(device.domain_bytes == Bytes{1, 2, 3, 4, 5, 6, 7, 0, 0, 0, 0, 0, 0, 0});
}
