// SPDX-License-Identifier: Apache-2.0
// Times of all services, for all start values and frequencies of the clock and all ways of waiting. [T15] [Q8]
#include "support/fixture.hpp"

namespace {

using namespace test;

// A sequence of timed actions. All times are multiples of 250 ms: whole numbers of ticks at 300, 1024 and 32768 Hz.
using Scenario = void (*)(Fixture&, std::vector<std::string>&);

void note(Fixture& node, std::vector<std::string>& all) {
  for (const std::string& line : node.trace()) all.push_back(line);
}

void heartbeats(Fixture& node, std::vector<std::string>& all) {
  node.after(2000ms);
  note(node, all);
  node.rx("000#0101");
  node.after(500ms);
  note(node, all);
  node.rx("601#2B171000E8030000");
  node.after(3000ms);
  note(node, all);
}

void heartbeat_through_reset(Fixture& node, std::vector<std::string>& all) {
  node.after(750ms);
  note(node, all);
  node.rx("000#8201");
  node.after(1000ms);
  note(node, all);
}

void sdo_time_out(Fixture& node, std::vector<std::string>& all) {
  node.rx("601#4008100000000000");
  note(node, all);
  node.after(node.sdo_time_out());
  for (const std::string& frame : node.frames()) {
    if (frame[0] == '5') all.push_back(frame);
  }
  node.rx("601#6001020300000000");
  for (const std::string& frame : node.frames()) all.push_back(frame);
}

unsigned ran;

void application_timers(Fixture& node, std::vector<std::string>& all) {
  ran = 0;
  node.call([&] {
    const std::uint32_t ticks = COTmrGetTicks(&node->Tmr, 250, CO_TMR_UNIT_1MS);
    COTmrCreate(
        &node->Tmr, ticks, ticks, [](void*) { ++ran; }, nullptr);
    COTmrCreate(
        &node->Tmr, 2 * ticks, 0, [](void*) { ran += 100; }, nullptr);
  });
  for (int i = 0; i < 8; ++i) {
    node.after(250ms);
    all.push_back(std::to_string(ran));
    note(node, all);
  }
}

constexpr Scenario scenarios[] = {heartbeats, heartbeat_through_reset, sdo_time_out, application_timers};

std::vector<std::string> play(Scenario scenario, Setup setup) {
  Fixture node(setup.heartbeat(250));
  std::vector<std::string> all;
  scenario(node, all);
  return all;
}

TEST_CASE("time: the trace does not depend on frequency and start of the clock [T15]") {
  for (const Scenario scenario : scenarios) {
    const std::vector<std::string> expected = play(scenario, Setup());
    CHECK(expected.size() >= 3);
    for (const std::uint32_t rate : clock_rates) {
      for (const std::uint32_t start : clock_starts) {
        CAPTURE(rate);
        CAPTURE(start);
        CHECK(play(scenario, Setup().rate(rate).clock(start)) == expected);
      }
    }
  }
}

TEST_CASE("time: the trace is identical for a polling loop and one that sleeps until alarm or deadline [T15]") {
  for (const Scenario scenario : scenarios) {
    const std::vector<std::string> expected = play(scenario, Setup());
    for (const Wake wake : {Wake::alarm, Wake::deadline, Wake::every_tick}) {
      for (const std::uint32_t start : clock_starts) {
        if (start == 0 && stride(2) > 1) continue;
        CAPTURE(start);
        CHECK(play(scenario, Setup().wake(wake).clock(start)) == expected);
        CHECK(play(scenario, Setup().wake(wake).clock(start).rate(300)) == expected);
      }
    }
  }
}

TEST_CASE("time: jumps of 1 ms to 10 s give at most one heartbeat, in phase [T15] [Q8]") {
  for (const auto jump : {1ms, 249ms, 250ms, 251ms, 499ms, 1000ms, 9999ms, 10000ms}) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(jump.count());
      CAPTURE(start);
      Fixture node(Setup().heartbeat(250).clock(start));
      node.jump(jump);
      CHECK(node.trace().size() == (jump < 250ms ? 0 : 1));
      const auto rest = 250ms - jump % 250ms;
      node.after(rest);
      node.tx_at(rest, "701#7F");
      node.silent();
    }
  }
}

TEST_CASE("time: a late main loop aborts an abandoned transfer once [Q8] [D18]") {
  Fixture node;
  node.ask("601#4008100000000000", "581#4108100011000000");
  node.jump(10 * std::chrono::milliseconds{CO_SDO_TIMEOUT});
  for (int i = 0; i < 10 && node.can.sent.empty(); ++i) node.after(std::chrono::milliseconds{CO_SDO_TIMEOUT} / 4);
  node.tx("581#8008100000000405");
}

TEST_CASE("time: CONodeNextDeadline is the next heartbeat, or none") {
  Fixture node(Setup().heartbeat(100));
  CHECK(CONodeNextDeadline(&node.node) == 100);
  node.after(30ms);
  CHECK(CONodeNextDeadline(&node.node) == 70);
  node.jump(70ms);
  node.tx("701#7F");
  CHECK(CONodeNextDeadline(&node.node) == 100);
  node.ask("601#2B17100000000000", "581#6017100000000000");
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
  CHECK(CONodeNextDeadline(nullptr) == 0xFFFFFFFF);
}

TEST_CASE("time: the main loop is woken only when the node has something to do") {
  Fixture node(Setup().heartbeat(1000));
  unsigned calls = 0;
  callbacks().lock = [&] { ++calls; };
  node.after(10000ms);
  CHECK(node.trace().size() == 10);
  CHECK(calls < 200);
}

}  // namespace
