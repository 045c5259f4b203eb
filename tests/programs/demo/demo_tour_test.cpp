// SPDX-License-Identifier: Apache-2.0
// Tests the tour of the demo's master with a clock that another program runs.
#include "co_cfg.h"

#if USE_CSDO  // the demo's master needs it
#include <doctest/doctest.h>

#include <array>
#include <sstream>
#include <string>

#include "co_nvm_ram.h"
#include "demo_simulation.hpp"
#include "host/exit.hpp"
#include "linux_master/tour.hpp"
#include "linux_node/clock.hpp"

namespace {

using lexican::second;

struct Elsewhere {
  Elsewhere() {
    CONvmRamClear(&ram);
    host.others = [this] { return is_there && live(); };
  }
  int run_tour() { return lexican::demo::run_clock_tour(5, host, {}, out); }
  /// Runs the clock for one step: it is called whenever the master waits, and advances the time when it has nothing to
  /// do.
  bool live() {
    if (!clock.node().process()) {
      host.pass(lexican::millisecond);
    }
    return true;
  }
  bool shows(const char* text) const { return out.str().find(text) != std::string::npos; }

  test::SimulatedHost host;
  std::ostringstream out;
  bool is_there = true;
  std::array<std::uint8_t, lexican::demo::clock_memory_size> bytes{};
  CO_NVM_RAM ram{bytes.data(), lexican::demo::clock_memory_size};
  lexican::demo::Clock clock{5, host.device_can(), host.device_timer(), {}, {&RamNvmDriver, &ram}};
};

}  // namespace

TEST_CASE("demo: the master runs the tour with a clock elsewhere on the bus") {
  Elsewhere elsewhere;
  REQUIRE(elsewhere.clock.start());
  CHECK(elsewhere.run_tour() == lexican::exit_ok);
  INFO(elsewhere.out.str());
  CHECK(elsewhere.shows("node    705  00                       boot-up"));
  CHECK(elsewhere.shows("master  605  40 08 10 00 00 00 00 00  SDO upload 1008h:00 device name"));
  CHECK(elsewhere.shows("ok  4608 bytes written"));
  CHECK(elsewhere.shows("ok  73728 bytes read, all as written"));
#if USE_PARA
  CHECK(elsewhere.shows("ok  time zone 60 min, as stored"));
#endif
  CHECK(elsewhere.shows(", all as expected"));
}

TEST_CASE("demo: the master resets a clock that booted before the master") {
  Elsewhere elsewhere;
  REQUIRE(elsewhere.clock.start());
  elsewhere.clock.node().process();
  elsewhere.host.pass(second / 2);
  CHECK(elsewhere.run_tour() == lexican::exit_ok);
  CHECK(elsewhere.shows("master  000  81 05                    NMT reset node, node 5"));
}

TEST_CASE("demo: a tour without a clock fails and ends") {
  Elsewhere elsewhere;
  elsewhere.is_there = false;
  CHECK(elsewhere.run_tour() == lexican::exit_failed);
  CHECK(elsewhere.shows("FAILED  no boot-up message of node 5"));
  CHECK(elsewhere.shows("not as expected"));
}

TEST_CASE("demo: a tour reports a lost bus and an interrupt") {
  Elsewhere lost;
  REQUIRE(lost.clock.start());
  lost.host.fault = "the adapter is gone";
  lost.host.lost = true;
  lost.host.interrupted_at = second / 2;
  CHECK(lost.run_tour() == lexican::exit_failed);
  CHECK(lost.shows("FAILED  the adapter is gone"));

  Elsewhere interrupted;
  REQUIRE(interrupted.clock.start());
  interrupted.host.interrupted_at = second / 2;
  CHECK(interrupted.run_tour() == lexican::exit_interrupted);
}
#endif
