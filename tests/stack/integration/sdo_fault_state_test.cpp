// SPDX-License-Identifier: Apache-2.0
// Tests state changes of either side during a block transfer, at every frame: the other side detects them, and the next
// transfer succeeds. [T11] [T14] [N8]
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/sdo_pair.hpp"

#if USE_CSDO && CO_CSDO_BLOCK > 0

namespace {

using namespace std::chrono_literals;
using test::both_directions;
using test::Direction;
using test::Milliseconds;
using test::SdoDevice;
using test::SdoPair;
using Micros = std::chrono::microseconds;

constexpr std::uint32_t bit_rate = 1000000;
constexpr std::uint32_t ticks_per_second = 1000000;
constexpr Micros frame_time{110};  // a little less than the duration of a frame with 8 bytes
constexpr Milliseconds client_time_out{1000};
constexpr Milliseconds enough_to_transfer{100};

enum class Side { client, server };

// A disturbance of a node, and its recovery.
struct Blow {
  std::string name;
  std::function<void(SdoPair&)> strike;
  std::function<void(SdoPair&)> heal;
  bool at_once = false;  ///< it can communicate again at once, without heal()
};

std::string nmt(const char* command, Side side) {
  return std::string("000#") + command + (side == Side::client ? "01" : "05");
}

Blow say(const char* name, Side side, const char* command, bool at_once) {
  return {name, [=](SdoPair& pair) { pair.line.say(nmt(command, side)); },
          [=](SdoPair& pair) { pair.line.say(nmt("01", side)); }, at_once};
}

SdoDevice& device_of(SdoPair& pair, Side side) { return side == Side::client ? pair.client : pair.server; }

std::vector<Blow> blows(Side side) {
  return {
      say("stop remote node", side, "02", false),
      say("reset node", side, "81", true),
      say("reset communication", side, "82", true),
      {"CONodeStop()", [=](SdoPair& pair) { CONodeStop(device_of(pair, side).node()); },
       [=](SdoPair& pair) { device_of(pair, side).power_up(); }},
      {"CONmtReset()", [=](SdoPair& pair) { CONmtReset(&device_of(pair, side)->Nmt, CO_RESET_COM); }, [](SdoPair&) {},
       true},
  };
}

CO_ERR set_client(SdoPair& pair, std::uint8_t sub, std::uint32_t cob_id) {
  return CODictWrLong(&pair.client->Dict, CO_DEV(0x1280, sub), cob_id);
}

Blow lose_client(std::uint32_t request, std::uint32_t response) {
  return {"1280h is not valid",
          [](SdoPair& pair) {
            CHECK(set_client(pair, 1, CO_SDO_ID_OFF) == CO_ERR_NONE);
            CHECK(set_client(pair, 2, CO_SDO_ID_OFF) == CO_ERR_NONE);
          },
          [=](SdoPair& pair) {
            CHECK(set_client(pair, 1, request) == CO_ERR_NONE);
            CHECK(set_client(pair, 2, response) == CO_ERR_NONE);
          }};
}

class Ring {
 public:
  Ring(std::uint32_t bytes, bool second_channel) : pair_({bytes, true, 0, 0, ticks_per_second, second_channel}) {
    pair_.line.bus.pace(bit_rate);
  }

  // Returns the duration of an undisturbed transfer in steps of one frame.
  unsigned steps(Direction direction) {
    const std::uint64_t begin = pair_.world.clock.elapsed();
    REQUIRE(pair_.run(direction, SdoPair::object, client_time_out, enough_to_transfer) == 0);
    return static_cast<unsigned>((pair_.device_client().tick - begin) / frame_time.count()) + 1;
  }

  // Disturbs the client at \a step. Returns true if the transfer was aborted, false if it was complete by then.
  bool strike_client(Direction direction, const Blow& blow, unsigned step) {
    strike(direction, blow, step);
    const std::uint32_t code = pair_.finish(enough_to_transfer);
    REQUIRE((code == 0 || code == CO_SDO_ERR_TOS_STATE));
    heal(blow);
    if (direction == Direction::download) {
      awake_server();
    }
    check_peace();
    return code != 0;
  }

  // Disturbs the server at \a step. A server that can communicate at once may interpret the remaining segments as any
  // request. [D21]
  bool strike_server(Direction direction, const Blow& blow, unsigned step) {
    strike(direction, blow, step);
    const std::uint32_t code = pair_.finish(enough_to_transfer + client_time_out + client_time_out / 4);
    REQUIRE((code == 0 || code == CO_SDO_ERR_TIMEOUT || blow.at_once));
    heal(blow);
    check_peace();
    return code != 0;
  }

 private:
  void strike(Direction direction, const Blow& blow, unsigned step) {
    pair_.start(direction, SdoPair::object, client_time_out);
    pair_.world.pass(step * frame_time);
    blow.strike(pair_);
  }

  // Lets the node recover, and the frames that are still queued arrive.
  void heal(const Blow& blow) {
    blow.heal(pair_);
    pair_.world.pass(enough_to_transfer);
  }

  // Starts a transfer that may fail: in the middle of a block the server interprets its initiate request as a segment.
  // The server detects the client's restart when that transfer is aborted, or after its own time-out. [301:7.2.4.3.10]
  void awake_server() { pair_.run(Direction::upload, SdoPair::value, 100ms, enough_to_transfer + 100ms); }

  void check_peace() {
    pair_.check_next(enough_to_transfer);
    REQUIRE(pair_.becomes_idle(std::chrono::milliseconds{CO_SDO_TIMEOUT + 100}));
    pair_.check_next(enough_to_transfer);
  }

  SdoPair pair_;
};

// Disturbs \a side at every \a stride-th step.
void strike_all(Ring& ring, Side side, const Blow& blow, unsigned stride) {
  CAPTURE(blow.name);
  for (const Direction direction : both_directions) {
    const unsigned steps = ring.steps(direction);
    unsigned hits = 0;
    for (unsigned step = 0; step <= steps; step += stride) {
      CAPTURE(step);
      const bool hit =
          side == Side::client ? ring.strike_client(direction, blow, step) : ring.strike_server(direction, blow, step);
      hits += hit ? 1 : 0;
    }
    CHECK(hits >= steps / stride * 9 / 10);
  }
}

void strike_all(Side side, std::uint32_t bytes, unsigned stride) {
  Ring ring(bytes, false);
  for (const Blow& blow : blows(side)) {
    strike_all(ring, side, blow, stride);
  }
}

}  // namespace

TEST_CASE("SDO faults: the client leaves at every frame of a block transfer [T11] [T14] [N8]") {
  strike_all(Side::client, 224, 1);
  strike_all(Side::client, 2000, 17);
}

TEST_CASE("SDO faults: the server leaves at every frame of a block transfer [T11] [T14] [N8]") {
  strike_all(Side::server, 224, 1);
  strike_all(Side::server, 2000, 17);
}

TEST_CASE("SDO faults: the client's COB-IDs change at every frame of a block transfer [T11]") {
  Ring ring(224, false);
  strike_all(ring, Side::client, lose_client(0x605, 0x585), 1);
}

#if CO_SSDO_N >= 2
TEST_CASE("SDO faults: the server's COB-IDs change at every frame of a block transfer [T11]") {
  Ring ring(224, true);
  const Blow lose_server = {"1201h is not valid", [](SdoPair& pair) { pair.server.close_second_channel(); },
                            [](SdoPair& pair) { pair.server.open_second_channel(); }};
  strike_all(ring, Side::server, lose_server, 1);
}
#endif

#endif
