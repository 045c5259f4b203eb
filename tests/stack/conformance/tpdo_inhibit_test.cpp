// SPDX-License-Identifier: Apache-2.0
// Inhibit time: 1800h…, sub 3. [301:7.2.2.6, 7.5.2.37]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0

namespace {

using namespace test;

PdoTable inhibited(std::uint16_t inhibit_100us, std::uint8_t type = 255, std::uint16_t event = 0) {
  PdoTable table;
  PdoEntries& pdo = table.tpdo[0].on(0x40000181, type, {0x22110108});
  pdo.inhibit = inhibit_100us;
  pdo.event = event;
  return table;
}

void change(PdoNode& node, std::uint8_t value) {
  node.call([&] { CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), value) == CO_ERR_NONE); });
}

TEST_CASE("TPDO inhibit: an event within the time is sent at its end with the current values [X6]") {
  PdoNode node(inhibited(1000));
  node.start();
  node.trigger(0);
  node.tx("181#11");
  node.after(40ms);
  CHECK(node.request(0) == CO_ERR_NONE);
  change(node, 0x22);
  node.after(30ms);
  change(node, 0x33);
  node.a8[0] = 0x44;
  node.silent();
  node.after(100ms);
  node.tx_at(30ms, "181#44");
  node.silent();
}

TEST_CASE("TPDO inhibit: the transmission at its end starts it again [X6]") {
  PdoNode node(inhibited(1000));
  node.start();
  node.trigger(0);
  node.trigger(0);
  node.tx("181#11");
  node.after(100ms);
  node.tx("181#11");
  node.trigger(0);
  node.silent();
  node.after(99ms);
  node.silent();
  node.after(1ms);
  node.tx("181#11");
  node.after(1000ms);
  node.silent();
}

TEST_CASE("TPDO inhibit: without an event within the time the next PDO is sent at once [X6]") {
  PdoNode node(inhibited(1000));
  node.start();
  for (int i = 0; i < 5; ++i) {
    node.trigger(0);
    node.tx("181#11");
    node.after(100ms);
    node.silent();
  }
}

TEST_CASE("TPDO inhibit: frequent events never send two PDOs within the time [X6]") {
  PdoNode node(inhibited(100));
  node.start();
  std::uint64_t last = 0;
  unsigned sent = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    change(node, static_cast<std::uint8_t>(ms));
    for (; !node.can.sent.empty(); node.can.sent.pop_front(), ++sent) {
      CHECK((sent == 0 || node.can.sent.front().tick - last >= 10));
      last = node.can.sent.front().tick;
    }
    node.after(1ms);
  }
  CHECK(sent == 100);
  node.after(20ms);
  node.tx("181#E7");  // the last value, 999 modulo 256, is sent
}

TEST_CASE("TPDO inhibit: a late main loop sends no two PDOs within the time [X6] [Q8]") {
  PdoNode node(inhibited(100));
  node.start();
  std::uint64_t last = 0;
  unsigned sent = 0;
  for (int i = 0; i < 200; ++i) {
    node.trigger(0);
    for (; !node.can.sent.empty(); node.can.sent.pop_front(), ++sent) {
      CAPTURE(i);
      CHECK((sent == 0 || node.can.sent.front().tick - last >= 10));
      last = node.can.sent.front().tick;
    }
    node.jump(std::chrono::milliseconds{1 + i * 7 % 13});
  }
  CHECK(sent > 30);
  node.frames();
}

TEST_CASE("TPDO inhibit: applies only to types 254 and 255 [X6]") {
  if (USE_SYNC == 0) {
    return;
  }
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{0, 1, 2, 240}) {
    CAPTURE(unsigned{type});
    SyncTable table;
    table.tpdo[0].on(0x40000181, type, {0x22110108}).inhibit = 60000;
    SyncNode node(table);
    node.start();
    const int syncs = type == 0 ? 1 : type;
    for (int round = 0; round < 3; ++round) {
      if (type == 0) {
        node.trigger(0);
      }
      for (int i = 0; i < syncs; ++i) {
        node.silent();
        node.rx("080#");
      }
      node.tx("181#11");
    }
  }
}

#if USE_PDO_RTR
TEST_CASE("TPDO inhibit: does not apply to remote requests of type 253, but to those of type 255 [X6] [X13]") {
  PdoTable table = inhibited(1000, 253);
  table.tpdo[0].cob_id = 0x181;
  PdoNode node(table);
  node.start();
  for (int i = 0; i < 3; ++i) {
    node.rx("181#R");
    node.tx("181#11");
  }
  table = inhibited(1000, 255);
  table.tpdo[0].cob_id = 0x181;
  PdoNode other(table);
  other.start();
  other.rx("181#R");
  other.tx("181#11");
  other.rx("181#R");
  other.silent();
  other.after(100ms);
  other.tx_at(100ms, "181#11");
}
#endif

TEST_CASE("TPDO inhibit: pending events are dropped when the PDO is switched off [X8] [D40]") {
  PdoNode node(inhibited(1000));
  node.start();
  node.trigger(0);
  node.trigger(0);
  node.tx("181#11");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.armed_timers() == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.after(1000ms);
  node.silent();
  node.trigger(0);
  node.tx("181#11");
}

TEST_CASE("TPDO inhibit: entering Operational starts without inhibit time and pending events [N11]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    PdoNode node(inhibited(1000));
    node.start();
    node.trigger(0);
    node.trigger(0);
    node.tx("181#11");
    node.rx(command);
    CHECK(node.armed_timers() == 0);
    node.start();
    node.trigger(0);
    node.tx("181#11");
    node.after(1000ms);
    node.silent();
  }
}

TEST_CASE("TPDO inhibit: the event timer respects it; a shorter event time has the inhibit time as period [X6] [X7]") {
  PdoNode node(inhibited(1000, 255, 30));
  node.start();
  node.after(330ms);
  node.tx_at(30ms, "181#11");
  node.tx_at(130ms, "181#11");
  node.tx_at(230ms, "181#11");
  node.tx_at(330ms, "181#11");
  node.silent();
}

TEST_CASE("TPDO inhibit: with a longer event time both start with the last transmission [X7]") {
  PdoNode node(inhibited(500, 255, 200));
  node.start();
  node.trigger(0);
  node.tx("181#11");
  node.after(20ms);
  node.trigger(0);
  node.silent();
  node.after(700ms);
  node.tx_at(30ms, "181#11");
  node.tx_at(230ms, "181#11");
  node.tx_at(430ms, "181#11");
  node.tx_at(630ms, "181#11");
  node.silent();
}

TEST_CASE("TPDO inhibit: an event time equal to it is kept") {
  PdoNode node(inhibited(1000, 255, 100));
  node.start();
  node.after(300ms);
  node.tx_at(100ms, "181#11");
  node.tx_at(200ms, "181#11");
  node.tx_at(300ms, "181#11");
}

TEST_CASE("TPDO inhibit: writing the event timer within the time does not shorten it [D40]") {
  PdoNode node(inhibited(1000));
  node.start();
  node.trigger(0);
  node.tx("181#11");
  node.after(10ms);
  CHECK(node.set(0x1800, 5, 2, 20) == 0);
  node.trigger(0);
  node.silent();
  node.after(90ms);
  node.tx("181#11");
  CHECK(node.set(0x1800, 5, 2, 0) == 0);
  node.trigger(0);
  node.silent();
  node.after(1000ms);
  node.tx_at(100ms, "181#11");
  node.silent();
  node.trigger(0);
  node.tx("181#11");
}

TEST_CASE("TPDO inhibit: times of 100 us and the longest one are kept") {
  PdoNode fine(inhibited(5), [](Setup& setup) { setup.rate(10000); });
  fine.start();
  fine.trigger(0);
  fine.trigger(0);
  fine.tx("181#11");
  fine.after(1ms);
  fine.tx_at(500us, "181#11");
  PdoNode longest(inhibited(65535));
  longest.start();
  longest.trigger(0);
  longest.trigger(0);
  longest.tx("181#11");
  longest.after(10000ms);
  longest.tx_at(6554ms, "181#11");  // 6553.5 ms, rounded up
}

TEST_CASE("TPDO inhibit: each PDO has its own time") {
  if (fixture_tpdos < 2) {
    return;
  }
  PdoTable table = inhibited(1000);
  table.tpdo[1].on(0x40000281, 255, {0x22110108}).inhibit = 300;
  PdoNode node(table);
  node.start();
  change(node, 1);
  node.tx({"181#01", "281#01"});
  change(node, 2);
  node.silent();
  node.after(200ms);
  node.tx_at(30ms, "281#02");
  node.tx_at(100ms, "181#02");
  node.silent();
}

}  // namespace

#endif
