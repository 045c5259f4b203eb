// SPDX-License-Identifier: Apache-2.0
// Times of PDOs and SYNC, for all start values and frequencies of the clock and all ways of waiting. [T15] [Q8]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 1 && CO_RPDO_N > 0 && USE_SYNC

namespace {

using namespace test;

// Returns PDOs whose times are multiples of 250 ms: whole numbers of ticks at 300, 1024 and 32768 Hz.
SyncTable table_of() {
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22110108}).event = 750;
  table.tpdo[0].on(0x40000181, 255, {0x22110108}).event = 1000;
  table.tpdo[0].inhibit = 2500;
  table.tpdo[1].on(0x40000281, 2, {0x22010208}).start = 2;
  table.sync_id = 0x40000080;
  table.cycle = 500000;
  table.window = 250000;
  table.counter = 4;
  return table;
}

std::vector<std::string> play(std::uint32_t rate, std::uint32_t clock, Wake wake) {
  SyncNode node(table_of(), [=](Setup& setup) { setup.rate(rate).clock(clock).wake(wake); });
  node.frames_per_call(16);
  std::vector<std::string> all;
  const auto pass = [&](Time time) {
    node.after(time);
    for (const std::string& line : node.trace()) all.push_back(line);
  };
  pass(1250ms);
  node.rx("000#0101");
  pass(500ms);
  node.rx("201#21");
  pass(250ms);
  node.trigger(0);
  node.trigger(0);
  pass(1500ms);
  node.rx("201#22");
  pass(3000ms);
  node.rx("000#0201");
  pass(1000ms);
  node.rx("000#0101");
  pass(1500ms);
  all.push_back(std::to_string(node.a8[0]));
  return all;
}

TEST_CASE("PDO time: the trace does not depend on frequency and start of the clock [T15]") {
  const std::vector<std::string> expected = play(1000, 0, Wake::alarm);
  CHECK(expected.size() >= 25);
  for (const std::uint32_t rate : clock_rates) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(rate);
      CAPTURE(start);
      CHECK(play(rate, start, Wake::alarm) == expected);
    }
  }
}

TEST_CASE("PDO time: the trace is identical for a polling loop and one that sleeps until alarm or deadline [T15]") {
  const std::vector<std::string> expected = play(1000, 0, Wake::alarm);
  for (const Wake wake : {Wake::alarm, Wake::deadline, Wake::every_tick}) {
    for (const std::uint32_t start : clock_starts) {
      if (start == 0 && stride(2) > 1) continue;
      CAPTURE(start);
      CHECK(play(1000, start, wake) == expected);
      CHECK(play(300, start, wake) == expected);
    }
  }
}

TEST_CASE("PDO time: after jumps of 1 ms to 10 s at most one frame of each kind is sent, in phase [T15] [Q8]") {
  for (const auto jump : {1ms, 249ms, 250ms, 251ms, 500ms, 1000ms, 1001ms, 9999ms, 10000ms}) {
    for (const std::uint32_t start : clock_starts) {
      CAPTURE(jump.count());
      CAPTURE(start);
      SyncTable table = table_of();
      table.tpdo[0].inhibit = 0;
      table.tpdo[0].event = 250;
      SyncNode node(table, [=](Setup& setup) { setup.clock(start); });
      node.frames_per_call(16);
      node.start();
      node.jump(jump);
      const std::vector<std::string> sent = node.frames();
      CHECK(std::count(sent.begin(), sent.end(), "181#11") == (jump < 250ms ? 0 : 1));
      CHECK(std::count(sent.begin(), sent.end(), "080#01") == (jump < 500ms ? 0 : 1));
      const auto rest = 500ms - jump % 500ms;
      node.after(rest);
      const std::vector<std::string> next = node.trace();
      const std::string at = std::to_string(rest.count()) + " ";
      CHECK(std::count(next.begin(), next.end(), at + "181#11") == 1);
      CHECK(std::count_if(next.begin(), next.end(), [&](const std::string& line) {
              return line.compare(0, at.size() + 3, at + "080") == 0;
            }) == 1);
    }
  }
}

TEST_CASE("PDO time: CONodeNextDeadline is the next action of PDOs and SYNC") {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108}).event = 70;
  table.tpdo[0].on(0x40000181, 255, {0x22110108}).event = 100;
  table.sync_id = 0x40000080;
  table.cycle = 40000;
  SyncNode node(table);
  CHECK(CONodeNextDeadline(&node.node) == 40);
  node.start();
  node.after(10ms);
  CHECK(CONodeNextDeadline(&node.node) == 30);
  node.after(30ms);
  node.tx("080#");
  CHECK(CONodeNextDeadline(&node.node) == 40);
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(CONodeNextDeadline(&node.node) == 60);
  node.rx("201#01");
  node.after(20ms);
  CHECK(CONodeNextDeadline(&node.node) == 40);
  CHECK(node.set(0x1800, 5, 2, 0) == 0);
  CHECK(CONodeNextDeadline(&node.node) == 50);
  CHECK(node.set(0x1400, 5, 2, 0) == 0);
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
}

}  // namespace

#endif
