// SPDX-License-Identifier: Apache-2.0
// Resets and stops injected after every frame of a scenario with PDOs and SYNC. [T14]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 3 && CO_RPDO_N > 1 && USE_SYNC

namespace {

using namespace test;

// Frames that are sent to the node, with time between them.
struct Scenario {
  std::string name;
  bool produces;
  std::vector<std::string> frames;
};

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
      {"consumer",
       false,
       {"000#0101", "201#01", "301#02", "080#01", "181#R", "301#03", "481#R", "080#02", "201#", "080#", "201#04",
        "301#0506", "080#04", "000#8001", "201#07", "000#0101", "080#02", "080#03"}},
      {"producer",
       true,
       {"000#0101", "201#01", "301#02", "181#R", "301#03", "481#R", "000#0201", "000#0101", "301#05", "000#8001"}},
      {"configuration",
       false,
       {"000#0101", "201#01", "301#02", "601#23001801810100C0", "601#2B0018030A000000", "601#2300180181010040",
        "080#01", "601#2F001802FE000000", "601#2F01180201000000", "080#02", "601#2B00180514000000", "301#01",
        "601#2F01140200000000", "301#02", "080#03"}},
      {"SYNC objects",
       true,
       {"000#0101", "601#2306100000000000", "601#2F1910000A000000", "601#2306100010270000", "301#02",
        "601#2305100080000000", "080#01", "601#23071000E8030000", "080#02", "601#2305100080000040"}},
  };
  return all;
}

SyncTable table_of(bool produces) {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22110108}).event = 9;
  table.rpdo[1].on(0x301, 1, {0x22010208});
  table.tpdo[0].on(USE_PDO_RTR != 0 ? 0x181 : 0x40000181, 255, {0x22110108}).event = 8;
  table.tpdo[0].inhibit = 30;
  table.tpdo[1].on(0x40000281, 2, {0x22010308}).start = 1;
  table.tpdo[2].on(0x40000381, 0, {0x22110108});
  table.tpdo[3].on(USE_PDO_RTR != 0 ? 0x481 : 0x40000481, 1, {0x22010508});
  table.sync_id = produces ? 0x40000080 : 0x80;
  table.cycle = produces ? 7000 : 0;
  table.window = 2000;
  table.counter = 4;
  return table;
}

void play(SyncNode& node, const Scenario& scenario, std::size_t steps, bool busy) {
  for (std::size_t i = 0; i < steps; ++i) {
    if (busy && i + 1 == steps) node.can.refuse_all();
    node.rx(scenario.frames[i]);
    node.frames();
    node.after(3ms);
    node.frames();
  }
}

void configure_as(SyncNode& node) {
  node.frames_per_call(32);
  for (unsigned n = 0; n < 4; ++n) {
    const auto at = [n](unsigned index) { return static_cast<std::uint16_t>(index + n); };
    for (const std::uint8_t sub : std::initializer_list<std::uint8_t>{1, 2, 3, 5, 6}) {
      node.may_change(at(0x1400), sub);
      node.may_change(at(0x1800), sub);
    }
  }
}

// Runs a sequence of frames after boot-up. Returns the sent frames and the received values.
std::vector<std::string> life(SyncNode& node) {
  std::vector<std::string> all;
  const auto note = [&] {
    for (const std::string& line : node.trace()) all.push_back(line);
  };
  node.after(20ms);
  note();
  for (const char* text :
       {"000#0101", "201#31", "301#32", "080#01", "080#02", "181#R", "481#R", "301#33", "080#03", "201#34"}) {
    node.rx(text);
    node.after(2ms);
    note();
  }
  node.after(30ms);
  note();
  all.push_back(std::to_string(node.a8[0]) + " " + std::to_string(node.u8[1]));
  return all;
}

// Returns life() of a new node whose initial values are the current values of \a node.
std::vector<std::string> life_of_fresh(const SyncNode& node) {
  SyncTable table;
  table.rpdo = node.rpdo;
  table.tpdo = node.tpdo;
  static_cast<SyncEntries&>(table) = node;
  SyncNode fresh(table);
  configure_as(fresh);
  std::copy(std::begin(node.u8), std::end(node.u8), fresh.u8);
  std::copy(std::begin(node.a8), std::end(node.a8), fresh.a8);
  std::vector<std::string> all = life(fresh);
  fresh.frames();
  return all;
}

void try_all(const char* command, bool busy) {
  for (const Scenario& scenario : scenarios()) {
    for (std::size_t steps = 0; steps <= scenario.frames.size(); steps += stride(5)) {
      CAPTURE(scenario.name);
      CAPTURE(steps);
      SyncNode node(table_of(scenario.produces));
      configure_as(node);
      play(node, scenario, steps, busy);
      node.rx(command);
      node.can.accept_all();
      node.loop();
      node.tx("701#00");
      const std::vector<std::string> expected = life_of_fresh(node);
      CHECK(life(node) == expected);
    }
  }
}

TEST_CASE("PDO reset: reset communication at any time gives the state after power-on [T14]") {
  try_all("000#8201", false);
}

TEST_CASE("PDO reset: reset node at any time gives the state after power-on [T14]") { try_all("000#8101", false); }

TEST_CASE("PDO reset: a reset drops frames that are queued for the controller [T14]") {
  try_all("000#8201", true);
  try_all("000#8101", true);
}

TEST_CASE("PDO reset: a stop at any time leaves no timer and no frame; CONodeInit starts anew [T14]") {
  for (const Scenario& scenario : scenarios()) {
    for (const bool busy : {false, true}) {
      for (std::size_t steps = 0; steps <= scenario.frames.size(); steps += stride(5)) {
        CAPTURE(scenario.name);
        CAPTURE(steps);
        SyncNode node(table_of(scenario.produces));
        configure_as(node);
        play(node, scenario, steps, busy);
        node.call([&] { CONodeStop(&node.node); });
        CHECK(node.armed_timers() == 0);
        node.can.accept_all();
        node.after(100ms);
        node.silent();
        node.init_again();
        node.call([&] { CONodeStart(&node.node); });
        node.tx("701#00");
        const std::vector<std::string> expected = life_of_fresh(node);
        CHECK(life(node) == expected);
        node.frames();
      }
    }
  }
}

TEST_CASE("PDO reset: a reset by the application leaves no timer from before it [T14] [D38]") {
  SyncNode node(table_of(true));
  configure_as(node);
  node.start();
  node.after(5ms);
  node.frames();
  const unsigned timers = node.armed_timers();
  for (int i = 0; i < 20; ++i) {
    node.call([&] { CONmtReset(&node->Nmt, CO_RESET_COM); });
    node.frames();
    node.rx("000#0101");
    node.after(5ms);
    node.frames();
    CHECK(node.armed_timers() == timers);
  }
}

}  // namespace

#endif
