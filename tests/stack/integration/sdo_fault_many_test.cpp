// SPDX-License-Identifier: Apache-2.0
// Tests three SDO clients of one node and two servers, one of them with two channels, that transfer at the same time on
// a bus that loses, duplicates, delays and swaps frames in a fixed pseudo-random order. [T11]
#include <doctest/doctest.h>

#include <array>
#include <random>
#include <string>

#include "support/sdo_pair_faults.hpp"

#if USE_CSDO && CO_CSDO_N >= 3 && CO_SSDO_N >= 2

namespace {

using namespace std::chrono_literals;
using co::VirtualBus;
using test::Direction;
using test::Exchange;
using test::Line;
using test::Milliseconds;
using test::SdoDevice;
using test::World;
using Fault = VirtualBus::Fault;

constexpr Milliseconds time_out{1000};
constexpr Milliseconds longest_delay{1500};

constexpr std::uint32_t keys[] = {CO_DEV(0x2010, 0), CO_DEV(0x2011, 0), CO_DEV(0x2012, 0)};

class Crowd {
 public:
  explicit Crowd(std::uint32_t bit_rate) {
    line_.stop_recording();
    first_.open_second_channel();
    clients_.connect(0, 5);
    clients_.connect(1, 5, 1);
    clients_.connect(2, 6);
    world_.pass(10ms);
    line_.bus.pace(bit_rate);
  }

  void run_round(unsigned round) {
    CAPTURE(round);
    add_faults();
    transfer();
    count_faults();
    line_.bus.clear_rules();
    world_.pass(longest_delay + Milliseconds{CO_SDO_TIMEOUT + 100});  // no delayed frame reaches the next round
    REQUIRE(first_.is_at_rest());
    REQUIRE(second_.is_at_rest());
    REQUIRE(clients_.is_at_rest());
  }

  void check_peace() {
    const unsigned before = done;
    transfer();
    REQUIRE(done == before + exchanges_.size());
  }

  unsigned done = 0;
  unsigned aborted = 0;
  std::array<std::uint32_t, 5> faults{};

 private:
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_() % limit); }

  // Adds faults to one frame in 250.
  void add_faults() {
    constexpr Fault kinds[] = {Fault::drop, Fault::duplicate, Fault::reorder, Fault::delay, Fault::delay};
    for (const Fault kind : kinds) {
      const Milliseconds delay{kind == Fault::delay ? 1 + below(1500) : 0};
      const auto match = [this](const VirtualBus::Traffic&) { return below(1250) == 0; };
      line_.bus.add_rule({kind, match, 1, VirtualBus::always, delay});
    }
  }

  void count_faults() {
    for (std::size_t rule = 0; rule < faults.size(); ++rule) {
      faults[rule] += line_.bus.struck(rule);
    }
  }

  void transfer() {
    for (std::size_t n = 0; n < exchanges_.size(); ++n) {
      SdoDevice& server = n == 2 ? second_ : first_;
      server.resize(keys[n], 1 + below(below(4) == 0 ? 40 : 3000));
      exchanges_[n].start(below(2) == 0 ? Direction::upload : Direction::download, keys[n], time_out);
    }
    wait();
    for (const Exchange& exchange : exchanges_) {
      REQUIRE(exchange.wrong() == "");
      exchange.device_client().code == 0 ? ++done : ++aborted;
    }
  }

  // Waits until all transfers are over. Each fault of a transfer costs at most a time-out; a transfer has no more than
  // 20.
  void wait() {
    for (unsigned n = 0; n < 400 && !is_over(); ++n) {
      world_.pass(50ms);
    }
    REQUIRE(is_over());
  }

  bool is_over() const {
    return exchanges_[0].device_client().is_over() && exchanges_[1].device_client().is_over() &&
           exchanges_[2].device_client().is_over();
  }

  std::mt19937 random_{402};
  World world_{1000000};
  Line& line_ = world_.add_line("crowd");
  SdoDevice first_{world_, line_, {5}};
  SdoDevice second_{world_, line_, {6}};
  SdoDevice clients_{world_, line_, {1}};
  std::array<Exchange, 3> exchanges_{Exchange{clients_, 0, first_}, Exchange{clients_, 1, first_},
                                     Exchange{clients_, 2, second_}};
};

}  // namespace

TEST_CASE("SDO faults: three clients and two servers at the same time get no wrong data with random faults [T11]") {
  for (const std::uint32_t bit_rate : {0u, 125000u, 1000000u}) {
    CAPTURE(bit_rate);
    const unsigned rounds = test::all_faults() ? 5000 : 200;
    Crowd crowd(bit_rate);
    crowd.check_peace();
    for (unsigned round = 0; round < rounds; ++round) {
      crowd.run_round(round);
    }
    crowd.check_peace();
    CHECK(crowd.done > 2 * rounds);
    CHECK(crowd.aborted > 0);
    for (const std::uint32_t faults : crowd.faults) {
      CHECK(faults > 0);
    }
  }
}

#endif
