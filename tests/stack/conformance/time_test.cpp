// SPDX-License-Identifier: Apache-2.0
// Times of all services, for all start values and frequencies of the clock and all ways of waiting. [T15] [Q8]
#include <algorithm>

#include "support/fixture.hpp"
#include "support/restricted_ids.hpp"
#include "support/time_fixture.hpp"

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

// 1012h, COB-ID TIME. [301:7.5.2.15]

#if USE_TIME

TEST_CASE("TIME: 1012h: bits 0 to 29 cannot be changed while bit 31 or 30 is set [Z1]") {
  for (const char* flag : {"80", "40", "C0"}) {
    CAPTURE(flag);
    const std::string f = flag;
    TimeNode node(0x00000100);
    node.ask("601#23121000000100" + f, "581#6012100000000000");
    node.ask("601#23121000000100" + f, "581#6012100000000000");
    node.ask("601#2312100010010080", "581#8012100030000906");
    node.ask("601#2312100081010040", "581#8012100030000906");
    node.ask("601#2312100081010000", "581#8012100030000906");
    node.ask("601#23121000000100A0", "581#8012100030000906");
    node.ask("601#2312100000010080", "581#6012100000000000");
    node.ask("601#2312100000010040", "581#6012100000000000");
    node.ask("601#23121000000100C0", "581#6012100000000000");
    node.ask("601#2312100000010000", "581#6012100000000000");
    node.ask("601#2312100081010000", "581#6012100000000000");
    node.ask("601#23121000820100C0", "581#6012100000000000");
    node.ask("601#4012100000000000", "581#43121000820100C0");
  }
}

TEST_CASE("TIME: 1012h: of all 11-bit CAN-IDs the restricted ones are refused [Z1] [301:7.3.5]") {
  TimeNode node(0x00000100);
  for (unsigned id = 0x7FF % stride(51); id <= 0x7FF; id += stride(51)) {
    if (id == 0x100) continue;
    CAPTURE(id);
    char request[32];
    std::snprintf(request, sizeof request, "601#23121000%02X%02X0000", id & 0xFFU, id >> 8);
    node.ask(request, is_forbidden(id) ? "581#8012100030000906" : "581#6012100000000000");
  }
  CHECK(node.cob_id == (CO_RESTRICTED_IDS == 0 ? 0x700U : 0x7FFU));
}

TEST_CASE("TIME: 1012h: bits 11 to 28 need bit 29, and with bit 29 a restricted value below 800h is refused [Z1]") {
  TimeNode node(0x00000100);
  node.ask("601#2312100000080080", "581#8012100030000906");
  node.ask("601#23121000FFFFFF9F", "581#8012100030000906");
  if (CO_RESTRICTED_IDS == 0) {
    node.ask("601#23121000010100A0", "581#8012100030000906");
  }
  node.ask("601#23121000000800A0", "581#6012100000000000");
  node.rx("00000800#010000000200");
  check_time(node, 1, 2);
}

TEST_CASE("TIME: 1012h: a restricted CAN-ID of the table can be written but not switched on [Z1]") {
  if (CO_RESTRICTED_IDS != 0) return;
  TimeNode node(0x00000101);
  node.ask("601#2312100001010000", "581#6012100000000000");
  node.ask("601#2312100001010080", "581#8012100030000906");
  node.ask("601#2312100000010080", "581#6012100000000000");
}

TEST_CASE("TIME: 1012h of a stopped node can be written without another effect") {
  TimeNode node(0x00000100);
  const std::vector<std::uint32_t> filter = node.can.filter;
  node.may_change(0x1012, 0);
  node.call([&] {
    CONodeStop(&node.node);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1012, 0), 0x80000100) == CO_ERR_NONE);
  });
  CHECK(node.can.filter == filter);
}

TEST_CASE("TIME: a new COB-ID takes effect at once in service and receive filter [N7]") {
  TimeNode node(0x00000100);
  const auto heard = [&](std::uint32_t id) {
    return std::count(node.can.filter.begin(), node.can.filter.end(), id) == 1;
  };
  CHECK_FALSE(heard(0x100));
  node.ask("601#2312100000010080", "581#6012100000000000");
  CHECK(heard(0x100));
  node.rx("100#010000000000");
  check_time(node, 1, 0);
  node.ask("601#2312100000010000", "581#6012100000000000");
  CHECK_FALSE(heard(0x100));
  node.ask("601#2312100081010080", "581#6012100000000000");
  CHECK(heard(0x181));
  node.rx("100#020000000000");
  check_time(node, 1, 0);
  node.rx("181#030000000000");
  check_time(node, 3, 0);
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(heard(0x181));
}

TEST_CASE("TIME: 1012h may be relative to the node-ID and have its value in the entry") {
  Fixture relative(Setup().only_small().node_id(5).with({CO_KEY(0x1012, 0, CO_OBJ_DN__R_), CO_TTIME_ID, 0x80000200}));
  relative.rx("205#010000000200");
  CO_TIME_OF_DAY now{};
  CHECK(COTimeGet(&relative.node, &now) == CO_ERR_NONE);
  CHECK(now.Days == 2);
  Fixture plain(Setup().only_small().with({CO_KEY(0x1012, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x80000100}));
  plain.rx("100#010000000300");
  CHECK(COTimeGet(&plain.node, &now) == CO_ERR_NONE);
  CHECK(now.Days == 3);
}

#if USE_DICT_CHECK

TEST_CASE("TIME: the type of 1012h is accepted at 1012h only") {
  Fixture node(Setup().only_small().with({CO_KEY(0x2500, 0, CO_OBJ_D___R_), CO_TTIME_ID, 0x100}).stay_in_init());
  CHECK(node.mode() == CO_INVALID);
  CHECK(node.error() == CO_ERR_DICT_INIT);
}

#endif

TEST_CASE("TIME: the macros for 1012h give its values") {
  CHECK(CO_COBID_TIME_STD(1, 0, 0x100) == 0x80000100);
  CHECK(CO_COBID_TIME_STD(0, 1, 0x100) == 0x40000100);
  CHECK(CO_COBID_TIME_STD(0, 0, 0x900) == 0x00000100);
  CHECK(CO_COBID_TIME_EXT(1, 1, 0x12345678) == 0xF2345678);
  CHECK(CO_COBID_TIME_EXT(0, 0, 0x2345) == 0x20002345);
}

#endif

}  // namespace
