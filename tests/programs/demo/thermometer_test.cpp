// SPDX-License-Identifier: Apache-2.0
// Tests the demo with a handwritten dictionary by its frames.
#include "co_cfg.h"

#if USE_CSDO  // the demo is built with it only
#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

#include "support/notation.hpp"
#include "thermometer/thermometer.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

namespace {

using namespace std::chrono_literals;
using Frames = std::vector<std::string>;

struct Bench {
  Bench() {
    drivers.Can = &co::VirtualBusDriver;
    drivers.CanCtx = &bus.attach({"thermometer"});
    drivers.Timer = &co::VirtualTimerDriver;
    drivers.TimerCtx = &timer;
    lexican::demo::make_thermometer(node, drivers, 7);
    bus.set_trace([this](const co::VirtualBus::Traffic& traffic) {
      if (traffic.sender != nullptr) {
        heard.push_back(test::notation(traffic.frame));
      }
    });
    CONodeStart(&node);
  }
  ~Bench() { CONodeStop(&node); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// Returns the frames that the thermometer sends within \a time.
  Frames after(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed <= time; passed += 1ms) {
      CONodeProcess(&node);
      COTmrProcess(&node.Tmr);
      if (passed < time) {
        clock.advance(clock.ticks(1ms));
      }
    }
    return std::move(heard);
  }
  Frames say(const char* frame) {
    heard.clear();
    bus.inject(test::frame(frame));
    return after(1ms);
  }

  CO_NODE node{};
  co::VirtualClock clock;
  co::VirtualTimer timer{clock, [this] { COTmrService(&node.Tmr); }};
  co::VirtualBus bus;
  CO_NODE_EXT drivers{};
  Frames heard;
};

}  // namespace

TEST_CASE("demo: the thermometer with a handwritten dictionary boots and sends heartbeats") {
  Bench bench;
  CHECK(CONodeGetErr(&bench.node) == CO_ERR_NONE);
  CHECK(bench.after(999ms) == Frames{"707#00", "707#7F"});
  CHECK(bench.say("607#2B17100064000000") == Frames{"587#6017100000000000"});
  CHECK(bench.after(200ms) == Frames{"707#7F", "707#7F"});
}

TEST_CASE("demo: the thermometer sends each new temperature in Operational, and an emergency above its limit") {
  Bench bench;
  bench.after(1ms);
  lexican::demo::set_temperature(bench.node, 215);
  CHECK(bench.after(1ms).empty());
  bench.say("000#0107");
  lexican::demo::set_temperature(bench.node, 215);
  CHECK(bench.after(1ms).empty());
  lexican::demo::set_temperature(bench.node, -5);
  CHECK(bench.after(1ms) == Frames{"187#FBFF"});
  CHECK(bench.say("607#2B012000E8FF0000") == Frames{"587#6001200000000000"});
  lexican::demo::set_temperature(bench.node, -24);
  CHECK(bench.after(1ms) == Frames{"187#E8FF"});
  lexican::demo::set_temperature(bench.node, -4);
  CHECK(bench.after(1ms) == Frames{"187#FCFF", "087#0040090000000000"});
  lexican::demo::set_temperature(bench.node, -30);
  CHECK(bench.after(1ms) == Frames{"187#E2FF", "087#0000000000000000"});
}

TEST_CASE("demo: the thermometer refuses what its dictionary does not allow") {
  Bench bench;
  bench.after(1ms);
  CHECK(bench.say("607#2B00200001000000") == Frames{"587#8000200002000106"});
  CHECK(bench.say("607#2F01200001000000") == Frames{"587#8001200013000706"});
  CHECK(bench.say("607#4002200000000000") == Frames{"587#8002200000000206"});
}
#endif
