// SPDX-License-Identifier: Apache-2.0
// Writes 1017h after the heartbeat timer has elapsed and before the loop sends the heartbeat. [301:7.2.8.3.2.1]
#include "support/fixture.hpp"

namespace {

using namespace test;

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
