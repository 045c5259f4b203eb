// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer. [301:7.2.8.2.2.1, 7.5.2.20]
#include "support/fixture.hpp"

namespace {

using namespace test;

TEST_CASE("heartbeat: sent every period after the boot-up, which counts as the first one [H1] [Heartbeat 02]") {
  Fixture node(Setup().heartbeat(1000));
  node.after(3500ms);
  node.tx_at(1000ms, "701#7F");
  node.tx_at(2000ms, "701#7F");
  node.tx_at(3000ms, "701#7F");
  node.silent();
}

TEST_CASE("heartbeat: it transmits the NMT state [N5] [Transition 01-04]") {
  Fixture node(Setup().heartbeat(100).node_id(0x22));
  node.after(100ms);
  node.tx("722#7F");
  node.rx("000#0122");
  node.after(100ms);
  node.tx("722#05");
  node.rx("000#0222");
  node.after(100ms);
  node.tx("722#04");
  node.rx("000#8022");
  node.after(100ms);
  node.tx("722#7F");
}

TEST_CASE("heartbeat: a change of the NMT state does not change its phase [H1]") {
  Fixture node(Setup().heartbeat(100));
  node.after(30ms);
  node.rx("000#0101");
  node.after(30ms);
  node.rx("000#0201");
  node.after(30ms);
  node.rx("000#8001");
  node.after(10ms);
  node.tx_at(10ms, "701#7F");
}

TEST_CASE("heartbeat: 1017h = 0 disables it [H1] [Heartbeat 03]") {
  Fixture node;
  node.after(70000ms);
  node.silent();
}

TEST_CASE("heartbeat: writing 1017h starts it at once [H1] [Heartbeat 01]") {
  Fixture node;
  node.ask("601#2B171000F4010000", "581#6017100000000000");
  node.ask("601#4017100000000000", "581#4B171000F4010000");
  node.after(1600ms);
  node.tx_at(500ms, "701#7F");
  node.tx_at(1000ms, "701#7F");
  node.tx_at(1500ms, "701#7F");
  node.silent();
}

TEST_CASE("heartbeat: a new time in 1017h takes effect immediately [H1]") {
  Fixture node(Setup().heartbeat(60000));
  node.after(1000ms);
  node.ask("601#2B17100064000000", "581#6017100000000000");
  node.after(250ms);
  node.tx_at(100ms, "701#7F");
  node.tx_at(200ms, "701#7F");
  node.silent();
  node.ask("601#2B17100000000000", "581#6017100000000000");
  node.after(70000ms);
  node.silent();
}

TEST_CASE("heartbeat: the application changes the time through the dictionary [H1]") {
  Fixture node;
  node.may_change(0x1017, 0);
  node.call([&] { CHECK(CODictWrWord(&node->Dict, CO_DEV(0x1017, 0), 20) == CO_ERR_NONE); });
  node.after(50ms);
  node.tx_at(20ms, "701#7F");
  node.tx_at(40ms, "701#7F");
  std::uint16_t time = 0;
  CHECK(CODictRdWord(&node->Dict, CO_DEV(0x1017, 0), &time) == CO_ERR_NONE);
  CHECK(time == 20);
}

TEST_CASE("heartbeat: it continues after both resets [N6]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    Fixture node(Setup().heartbeat(100));
    node.after(250ms);
    node.tx({"701#7F", "701#7F"});
    node.rx(reset);
    node.tx("701#00");
    node.after(250ms);
    node.tx_at(100ms, "701#7F");
    node.tx_at(200ms, "701#7F");
    node.silent();
  }
}

TEST_CASE("heartbeat: none is sent before the node is started [N3]") {
  Fixture node(Setup().heartbeat(100).stay_in_init());
  node.after(1000ms);
  node.silent();
  node.call([&] { CONodeStart(&node.node); });
  node.tx("701#00");
  node.after(100ms);
  node.tx_at(100ms, "701#7F");
}

TEST_CASE("heartbeat: none is sent after a stop of the node") {
  Fixture node(Setup().heartbeat(100));
  node.call([&] { CONodeStop(&node.node); });
  node.after(1000ms);
  node.silent();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("heartbeat: no period is lost or added over an hour [T15]") {
  Fixture node(Setup().heartbeat(1000).rate(32768));
  constexpr unsigned seconds = 3600 / stride(6);
  node.after(seconds * 1s);
  CHECK(node.trace().size() == seconds);
}

TEST_CASE("heartbeat: it needs no timer of the application's pool") {
  Fixture node(Setup().heartbeat(10).timers(0));
  node.after(10ms);
  node.tx("701#7F");
  CHECK(node.error() == CO_ERR_NONE);
}

TEST_CASE("heartbeat: times of 1 ms and of 65535 ms are kept [H1]") {
  Fixture node;
  node.ask("601#2B17100001000000", "581#6017100000000000");
  node.after(3ms);
  node.tx({"701#7F", "701#7F", "701#7F"});
  node.ask("601#2B171000FFFF0000", "581#6017100000000000");
  node.after(65534ms);
  node.silent();
  node.after(1ms);
  node.tx("701#7F");
}

TEST_CASE("heartbeat: a time beyond the range of the timer is refused, and the old one stays [H1]") {
  Fixture node(Setup().heartbeat(100).rate(1000000000));
  node.ask("601#2B171000FFFF0000", "581#8017100030000906");
  node.ask("601#4017100000000000", "581#4B17100064000000");
  node.after(100ms);
  node.tx("701#7F");
}

TEST_CASE("heartbeat: a late main loop sends one heartbeat and keeps the phase [Q8]") {
  Fixture node(Setup().heartbeat(100));
  node.jump(1050ms);
  node.tx("701#7F");
  node.after(100ms);
  node.tx_at(50ms, "701#7F");
  node.silent();
}

TEST_CASE("heartbeat: the time may be stored in the entry (flag D)") {
  Fixture node(Setup().with({CO_KEY(0x1017, 0, CO_OBJ_D___RW), CO_THB_PROD, 50}));
  node.after(50ms);
  node.tx("701#7F");
  node.ask("601#4017100000000000", "581#4B17100032000000");
  node.ask("601#2B17100000000000", "581#6017100000000000");
  node.after(1000ms);
  node.silent();
  node.ask("601#4017100000000000", "581#4B17100000000000");
}

TEST_CASE("heartbeat: without 1017h none is sent") {
  Fixture node(Setup().without(0x1017, 0));
  node.after(5000ms);
  node.silent();
}

// Writes 1017h after the heartbeat timer has elapsed and before the loop sends the heartbeat. [301:7.2.8.3.2.1]

struct Change {
  const char* request;
  std::uint16_t ms;
};

const Change changes[] = {
    {"601#2B17100032000000", 50},   // sooner
    {"601#2B171000FA000000", 250},  // later
    {"601#2B17100064000000", 100},  // unchanged
    {"601#2B17100000000000", 0},    // off
};

// Returns the expected heartbeats of 1 s. The new time starts with the write; the elapsed heartbeat is not sent.
std::vector<std::string> expected_trace(std::uint16_t ms) {
  std::vector<std::string> lines;
  for (unsigned due = ms; ms != 0 && due <= 1000; due += ms) lines.push_back(std::to_string(due) + " 701#7F");
  return lines;
}

void process_timers(Fixture& node) {
  node.call([&] { COTmrProcess(&node->Tmr); });
}

TEST_CASE("heartbeat change: by SDO while a period has elapsed and its heartbeat is not sent [H1]") {
  for (const Wake wake : {Wake::alarm, Wake::deadline, Wake::every_tick}) {
    for (const std::uint32_t start : clock_starts) {
      for (const Change& change : changes) {
        CAPTURE(change.ms);
        CAPTURE(start);
        Fixture node(Setup().only_small().heartbeat(100).wake(wake).clock(start));
        node.elapse_only(100ms);
        node.ask(change.request, "581#6017100000000000");
        process_timers(node);
        node.silent();
        node.after(1000ms);
        CHECK(node.trace() == expected_trace(change.ms));
        CHECK(node.armed_timers() == (change.ms == 0 ? 0 : 1));
      }
    }
  }
}

TEST_CASE("heartbeat change: by the application several periods after the last heartbeat [H1]") {
  for (const Change& change : changes) {
    CAPTURE(change.ms);
    Fixture node(Setup().only_small().heartbeat(100));
    node.may_change(0x1017, 0);
    node.elapse_only(350ms);
    node.call([&] { CHECK(CODictWrWord(&node->Dict, CO_DEV(0x1017, 0), change.ms) == CO_ERR_NONE); });
    process_timers(node);
    node.silent();
    node.after(1000ms);
    CHECK(node.trace() == expected_trace(change.ms));
  }
}

unsigned runs;

void count_run(void*) { ++runs; }

TEST_CASE("heartbeat change: timers of the application that have elapsed with it are run [H1]") {
  for (const Change& change : changes) {
    for (const bool before : {true, false}) {
      CAPTURE(change.ms);
      CAPTURE(before);
      runs = 0;
      Fixture node(Setup().only_small().heartbeat(before ? 0 : 100));
      node.call([&] { COTmrCreate(&node->Tmr, 100, 0, count_run, nullptr); });
      if (before) node.ask("601#2B17100064000000", "581#6017100000000000");
      node.elapse_only(100ms);
      node.ask(change.request, "581#6017100000000000");
      process_timers(node);
      CHECK(runs == 1);
      node.after(1000ms);
      CHECK(node.trace() == expected_trace(change.ms));
      CHECK(runs == 1);
    }
  }
}

TEST_CASE("heartbeat change: after a reset with an elapsed heartbeat the boot-up is the first frame [N6] [H1]") {
  for (const std::string reset : {"000#8101", "000#8201"}) {
    CAPTURE(reset);
    Fixture node(Setup().only_small().heartbeat(100));
    node.elapse_only(100ms);
    node.ask(reset, "701#00");
    process_timers(node);
    node.silent();
    node.after(1000ms);
    CHECK(node.trace() == expected_trace(100));
  }
}

}  // namespace
