// SPDX-License-Identifier: Apache-2.0
// Tests SDO transfers between a Lexican client and a Lexican server whose controllers refuse some frames: no answer and
// no other frame of the nodes is lost. [T12] [Q4] [D20]
#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <random>
#include <string>

#include "support/sdo_pair.hpp"

#if USE_CSDO

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::both_directions;
using test::Direction;
using test::Milliseconds;
using test::SdoDevice;
using test::SdoPair;
using test::SdoPairOptions;
using Fault = VirtualBus::Fault;

constexpr std::uint16_t heartbeat_ms = 10;
constexpr std::uint32_t answer_of_client = 0x580 + SdoPair::client_id;
constexpr std::uint32_t second_answer_of_server = 0x1C0 + SdoPair::server_id;
constexpr bool has_second_channel = CO_SSDO_N >= 2;
constexpr std::uint32_t heartbeat_of_client = 0x700 + SdoPair::client_id;
constexpr std::uint32_t heartbeat_of_server = 0x700 + SdoPair::server_id;

// A client and a server, one of which has a failing controller, and the number of frames on the bus by identifier.
class Bench {
 public:
  Bench(const SdoPairOptions& options, bool client) : pair_(options), side_(client ? pair_.client : pair_.server) {
    if (has_second_channel) {
      pair_.server.open_second_channel();
      pair_.world.settle();
    }
    pair_.line.bus.set_trace([this](const VirtualBus::Traffic& traffic) { ++on_bus_[traffic.frame.Identifier]; });
  }

  // Returns the number of frames that this side offers in an undisturbed transfer and in answers to the other requests.
  std::uint32_t count_offers(Direction direction) {
    std::uint32_t offers = 0;
    pair_.line.bus.add_rule({Fault::refuse, [&](const VirtualBus::Traffic& traffic) {
                               offers += is_of_side(traffic) ? 1U : 0U;
                               return false;
                             }});
    CHECK(run(direction, 0ms) == 0);
    pair_.line.bus.clear_rules();
    return offers;
  }

  // Refuses \a times offers from number \a first on. Each refusal may delay the frame by a millisecond.
  void refuse(Direction direction, Fault fault, std::uint32_t first, std::uint32_t times) {
    CAPTURE(first);
    CAPTURE(times);
    const auto match = [this](const VirtualBus::Traffic& traffic) { return is_of_side(traffic); };
    pair_.line.bus.add_rule({fault, match, first, times});
    REQUIRE(run(direction, Milliseconds{times + 1}) == 0);
    pair_.line.bus.clear_rules();
    check_others(times < heartbeat_ms);
    REQUIRE(CONodeGetErr(side_.node()) == (fault == Fault::error ? CO_ERR_IF_CAN_SEND : CO_ERR_NONE));
  }

  // Refuses all offers for \a time, beginning with number \a first.
  void refuse_for(Direction direction, std::uint32_t first, Milliseconds time) {
    std::uint32_t seen = 0;
    VirtualBus::Time end{0};
    const auto match = [&](const VirtualBus::Traffic& traffic) {
      const bool counts = is_of_side(traffic);
      if (counts && ++seen == first) {
        end = traffic.time + time;
      }
      return counts && traffic.time < end;
    };
    pair_.line.bus.add_rule({Fault::refuse, match, 1, VirtualBus::always});
    REQUIRE(run(direction, time + 1ms) == 0);
    pair_.line.bus.clear_rules();
    check_others(time < Milliseconds{heartbeat_ms});
  }

  // Refuses \a percent of the offers of both sides.
  void refuse_at_random(Direction direction, std::uint32_t percent) {
    const auto match = [&](const VirtualBus::Traffic& traffic) {
      return traffic.sender != &pair_.line.master && random_() % 100 < percent;
    };
    pair_.line.bus.add_rule({Fault::refuse, match, 1, VirtualBus::always});
    REQUIRE(run(direction, 900ms) == 0);
    pair_.line.bus.clear_rules();
    check_others();
  }

  // Stops the bus for \a time after frame \a position. Returns the abort code of the transfer.
  std::uint32_t hold_bus(Direction direction, std::uint32_t position, Milliseconds time) {
    std::uint32_t seen = 0;
    pair_.line.bus.add_rule({Fault::none, [&](const VirtualBus::Traffic&) {
                               if (++seen == position) {
                                 pair_.line.bus.hold();
                               }
                               return false;
                             }});
    begin(direction);
    pair_.world.pass(time);
    pair_.line.bus.release();
    pair_.line.bus.clear_rules();
    const std::uint32_t code = pair_.finish(time + 1250ms);
    check_others();
    return code;
  }

  // Sets the controller to bus-off for \a time at this offer: it neither sends nor receives.
  void go_bus_off(Direction direction, std::uint32_t offer, Milliseconds time) {
    const auto match = [this](const VirtualBus::Traffic& traffic) { return is_of_side(traffic); };
    pair_.line.bus.add_rule({Fault::bus_off, match, offer});
    begin(direction);
    pair_.world.pass(time);
    side_.port().recover();
    pair_.finish(time + 2500ms);
    pair_.line.bus.clear_rules();
    check_next();
  }

  // Refuses the frames like refuse(), but permits lost frames. Returns the abort code of the transfer.
  std::uint32_t squeeze(Direction direction, std::uint32_t first, std::uint32_t times) {
    const auto match = [this](const VirtualBus::Traffic& traffic) { return is_of_side(traffic); };
    pair_.line.bus.add_rule({Fault::refuse, match, first, times});
    const std::uint32_t code = run(direction, 2500ms);
    pair_.line.bus.clear_rules();
    check_next();
    return code;
  }

  // Starts a transfer that may fail before the one that must succeed: a server in the middle of a block that has not
  // received the client's abort interprets the first initiate request as a segment.
  void check_next() {
    pair_.run(Direction::upload, SdoPair::value, 1000ms, 1000ms);
    pair_.check_next();
  }

 private:
  bool is_of_side(const VirtualBus::Traffic& traffic) const { return traffic.sender == &side_.port(); }

  // Starts the transfer, and sends requests to the client's node and to the second SDO channel of the server.
  void begin(Direction direction) {
    on_bus_.clear();
    heartbeats_before_ = heartbeats_due();
    pair_.start(direction);
    pair_.line.say("601#4000100000000000");
    pair_.line.say("245#4000100000000000");
    pair_.world.settle();
  }

  std::uint32_t run(Direction direction, Milliseconds limit) {
    begin(direction);
    const std::uint32_t code = pair_.finish(limit);
    pair_.world.pass(limit);  // the answers to the other requests are sent
    return code;
  }

  std::uint64_t heartbeats_due() const {
    return static_cast<std::uint64_t>(pair_.world.clock.time() / Milliseconds{heartbeat_ms});
  }

  // Checks that no answer is lost, and of the heartbeats only queued ones that a newer one has replaced.
  void check_others(bool all_heartbeats = false) {
    REQUIRE(on_bus_[answer_of_client] == 1);
    REQUIRE(on_bus_[second_answer_of_server] == (has_second_channel ? 1 : 0));
    REQUIRE(pair_.client.counters().Dropped == 0);
    REQUIRE(pair_.server.counters().Dropped == 0);
    const std::uint64_t due = heartbeats_due() - heartbeats_before_;
    pair_.world.pass(10 * Milliseconds{heartbeat_ms});
    for (const std::uint32_t heartbeat : {heartbeat_of_client, heartbeat_of_server}) {
      REQUIRE(on_bus_[heartbeat] >= (all_heartbeats ? due : 0) + 10);
      REQUIRE(on_bus_[heartbeat] <= due + 10);
    }
  }

  SdoPair pair_;
  SdoDevice& side_;
  std::map<std::uint32_t, unsigned> on_bus_;
  std::uint64_t heartbeats_before_ = 0;
  std::mt19937 random_{12};
};

// Expedited, segmented with 8 segments, and block with 32 segments.
constexpr SdoPairOptions transfers[] = {{4, true, heartbeat_ms}, {50, false, heartbeat_ms}, {224, true, heartbeat_ms}};

// Calls \a test for each transfer, with the failing controller on either side, and the number of its offers.
template <class Test>
void with_all_benches(std::uint16_t tx_queue, const Test& test) {
  for (SdoPairOptions options : transfers) {
    options.tx_queue = tx_queue;
    for (const bool client : {true, false}) {
      Bench bench(options, client);
      for (const Direction direction : both_directions) {
        CAPTURE(options.bytes);
        CAPTURE(client);
        test(bench, direction, bench.count_offers(direction));
      }
    }
  }
}

}  // namespace

TEST_CASE("SDO send failure: a transfer is complete, whichever frames the driver refuses [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (const Fault fault : {Fault::refuse, Fault::error}) {
      for (const std::uint32_t times : {1u, 2u, 3u, 10u, 60u}) {
        for (std::uint32_t first = 1; first <= offers; ++first) {
          bench.refuse(direction, fault, first, times);
        }
      }
    }
  });
}

TEST_CASE("SDO send failure: a transfer is complete when the controller refuses frames temporarily [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (const Milliseconds time : {1ms, 6ms, 9ms, 100ms}) {
      for (std::uint32_t first = 1; first <= offers; ++first) {
        CAPTURE(first);
        CAPTURE(time.count());
        bench.refuse_for(direction, first, time);
      }
    }
  });
}

TEST_CASE("SDO send failure: a transfer is complete if the drivers of both refuse at random [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t) {
    for (const std::uint32_t percent : {10u, 50u, 90u}) {
      CAPTURE(percent);
      bench.refuse_at_random(direction, percent);
    }
  });
}

TEST_CASE("SDO send failure: a transfer is complete when the bus is blocked temporarily [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (const Milliseconds time : {1ms, 30ms, 200ms}) {
      for (std::uint32_t position = 1; position <= 2 * offers; ++position) {
        CAPTURE(position);
        CAPTURE(time.count());
        REQUIRE(bench.hold_bus(direction, position, time) == 0);
      }
    }
  });
}

TEST_CASE("SDO send failure: a transfer is complete or reported when the bus is blocked until time-outs [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (const Milliseconds time : {400ms, 900ms, 1300ms, 2500ms}) {
      for (std::uint32_t position = 1; position <= 2 * offers; ++position) {
        CAPTURE(position);
        CAPTURE(time.count());
        bench.hold_bus(direction, position, time);
        bench.check_next();
      }
    }
  });
}

TEST_CASE("SDO send failure: a transfer is complete or reported when a controller is in bus-off temporarily [T12]") {
  with_all_benches(0, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (const Milliseconds time : {10ms, 300ms, 1500ms}) {
      for (std::uint32_t offer = 1; offer <= offers; ++offer) {
        CAPTURE(offer);
        CAPTURE(time.count());
        bench.go_bus_off(direction, offer, time);
      }
    }
  });
}

// A node queues at most three frames at the same time: an answer of its client or server, another answer, a heartbeat.
TEST_CASE("SDO send failure: three slots in the transmit queue are enough for a complete transfer [T12] [Q4]") {
  with_all_benches(3, [](Bench& bench, Direction direction, std::uint32_t offers) {
    for (std::uint32_t first = 1; first <= offers; ++first) {
      CAPTURE(first);
      bench.refuse_for(direction, first, 9ms);
      bench.refuse_for(direction, first, 100ms);
    }
  });
}

TEST_CASE("SDO send failure: with fewer slots a transfer is complete or reported [T12] [Q4]") {
  for (std::uint16_t tx_queue = 1; tx_queue <= 2; ++tx_queue) {
    CAPTURE(tx_queue);
    unsigned done = 0;
    with_all_benches(tx_queue, [&](Bench& bench, Direction direction, std::uint32_t offers) {
      for (const std::uint32_t times : {1u, 3u, 60u}) {
        for (std::uint32_t first = 1; first <= offers; ++first) {
          done += bench.squeeze(direction, first, times) == 0 ? 1U : 0U;
        }
      }
    });
    CHECK(done > 0);
  }
}

#endif
