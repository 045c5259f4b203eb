// SPDX-License-Identifier: Apache-2.0
// Tests block transfers between a Lexican node and a peer that is typed from the standard, with blocks of any size:
// one fault at every position. [T11]
#include <doctest/doctest.h>

#include <chrono>

#include "support/sdo_pair_faults.hpp"
#include "support/sdo_pair_foreign.hpp"

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::both_directions;
using test::Bytes;
using test::DeviceClient;
using test::Direction;
using test::ForeignClient;
using test::ForeignServer;
using test::frame_faults;
using test::FrameFault;
using test::Line;
using test::Milliseconds;
using test::SdoDevice;
using test::World;
using Fault = VirtualBus::Fault;

constexpr std::uint8_t server_id = 5;
constexpr std::uint32_t bytes = 89;  // 13 segments
constexpr std::uint32_t object = CO_DEV(0x2010, 0);
constexpr Milliseconds both_time_outs{4000};

// A Lexican client and a server that is typed from the standard. transfer() transfers the data of \a seed and returns
// the abort code; it requires the right data where that is 0.
class OurClient {
 public:
  explicit OurClient(std::uint8_t blksize) : server_(line, server_id, blksize) { client_.connect(0, server_id); }

  std::uint32_t transfer(Direction direction, std::uint32_t seed) {
    const Bytes data = test::noise(bytes, seed);
    DeviceClient& device_client = client_.device_clients[0];
    if (direction == Direction::upload) {
      server_.object = data;
      REQUIRE(device_client.upload(object, bytes, 1000ms) == CO_ERR_NONE);
    } else {
      REQUIRE(device_client.download(object, data, 1000ms) == CO_ERR_NONE);
    }
    pass(both_time_outs, [&] { return device_client.is_over(); });
    REQUIRE(device_client.is_over());
    REQUIRE((device_client.code != 0 ||
             (device_client.num == bytes && device_client.data() == data && server_.object == data)));
    return device_client.code;
  }

  World world;
  Line& line = world.add_line("foreign");

  // Runs both nodes until \a is_over, at most for \a time.
  template <class Condition>
  void pass(Milliseconds time, const Condition& is_over) {
    constexpr Milliseconds step{10};
    for (Milliseconds passed{0}; passed <= time; passed += step) {
      do {
        world.settle();
      } while (server_.work());
      if (is_over()) {
        return;
      }
      world.pass(step);
      server_.pass(step);
    }
  }
  void pass(Milliseconds time) {
    pass(time, [] { return false; });
  }

 private:
  ForeignServer server_;
  SdoDevice client_{world, line, {1}};
};

class OurServer {
 public:
  explicit OurServer(std::uint8_t blksize) : client_(world, line, server_id, blksize) {}

  std::uint32_t transfer(Direction direction, std::uint32_t seed) {
    const Bytes data = test::noise(bytes, seed);
    if (direction == Direction::upload) {
      server_.fill(object, data);
      const std::uint32_t code = client_.upload(CO_GET_IDX(object));
      REQUIRE((code != 0 || client_.data == data));
      return code;
    }
    const std::uint32_t code = client_.download(CO_GET_IDX(object), data);
    REQUIRE((code != 0 || server_.read(object) == data));
    return code;
  }

  World world;
  Line& line = world.add_line("foreign");

  void pass(Milliseconds time) { world.pass(time); }

 private:
  SdoDevice server_{world, line, {server_id, {bytes, 16, 16}}};
  ForeignClient client_;
};

template <class Pair>
std::uint32_t count_frames(Pair& pair, Direction direction) {
  const std::size_t rule = pair.line.bus.add_rule({Fault::none, {}, 1, VirtualBus::always});
  REQUIRE(pair.transfer(direction, 0) == 0);
  const std::uint32_t frames = pair.line.bus.struck(rule);
  pair.line.bus.clear_rules();
  return frames;
}

// Applies a fault to one transfer. Requires that the next transfer succeeds, both at once and after delayed frames have
// arrived and both sides have timed out.
template <class Pair>
void disturb(Pair& pair, Direction direction, const FrameFault& fault, std::uint32_t position) {
  const std::size_t rule = pair.line.bus.add_rule({fault.kind, {}, position, 1, fault.delay});
  pair.transfer(direction, position);
  REQUIRE(pair.line.bus.struck(rule) == 1);
  pair.line.bus.clear_rules();
  if (fault.kind == Fault::reorder) {
    pair.transfer(direction, position + 1000);  // disturbed by the frame that was held to be swapped
  }
  REQUIRE(pair.transfer(direction, position + 2000) == 0);
  pair.pass(fault.delay + both_time_outs);
  REQUIRE(pair.transfer(direction, position + 3000) == 0);
}

template <class Pair>
void disturb_all() {
  for (const unsigned blksize : {1u, 2u, 5u, 127u}) {
    Pair pair(static_cast<std::uint8_t>(blksize));
    for (const Direction direction : both_directions) {
      const std::uint32_t frames = count_frames(pair, direction);
      for (std::uint32_t position = 1; position <= frames; ++position) {
        for (const FrameFault& fault : frame_faults) {
          CAPTURE(blksize);
          CAPTURE(position);
          CAPTURE(fault.kind);
          CAPTURE(fault.delay.count());
          disturb(pair, direction, fault, position);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("SDO faults: with a server model and blksize 1/2/5/127 a fault of one frame gives no wrong data [T11]") {
  disturb_all<OurClient>();
}

TEST_CASE("SDO faults: with a client model and blksize 1/2/5/127 a fault of one frame gives no wrong data [T11]") {
  disturb_all<OurServer>();
}

#endif
