// SPDX-License-Identifier: Apache-2.0
// PDOs and SYNC in every NMT state and at every transition. [N3] [N7] [N11] [X9] [E10] [State 02-04] [PDO 09-20]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 3 && CO_RPDO_N > 1 && USE_SYNC

namespace {

using namespace test;

// Returns a table with PDOs of each kind.
SyncTable all_kinds() {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.rpdo[1].on(0x301, 1, {0x22010208});
  table.tpdo[0].on(0x181, 255, {0x22110108}).event = 100;
  table.tpdo[0].inhibit = 2000;
  table.tpdo[1].on(0x40000281, 1, {0x22010308});
  table.tpdo[2].on(0x40000381, 0, {0x22010408});
  table.tpdo[3].on(USE_PDO_RTR != 0 ? 0x481 : 0x40000481, USE_PDO_RTR != 0 ? 252 : 240, {0x22010508});
  return table;
}

// Triggers all PDOs by frames, by the application and by time, and checks that none is sent or received.
void stir(SyncNode& node) {
  node.rx("201#71");
  node.rx("301#72");
  node.rx("080#");
  const auto collect = [&] {
    for (const std::string& text : node.frames()) {
      ADD_FAIL_CHECK_AT(__FILE__, __LINE__, "sent " << text);
    }
  };
  collect();
  node.rx("181#R");
  node.rx("481#R");
  collect();
  for (std::uint16_t n = 0; n < 4; ++n) {
    CHECK(node.request(n) == CO_ERR_NMT_MODE);
  }
  node.call([&] { CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), static_cast<std::uint8_t>(node.a8[0] + 1)); });
  node.call([&] { COTPdoTrigObj(node->TPdo, node.find(0x2211, 1)); });
  CHECK(node.error() == CO_ERR_NMT_MODE);
  node.after(1000ms);
  collect();
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0x21);
  CHECK(node.objects.error_register == 0);
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("PDO state: no PDO is processed in Pre-operational [N3] [X9] [PDO 15] [PDO 16] [PDO 20]") {
  SyncNode node(all_kinds());
  stir(node);
}

TEST_CASE("PDO state: no PDO is processed in Stopped [N3] [X9] [PDO 09] [PDO 14] [State 04]") {
  SyncNode node(all_kinds());
  node.rx("000#0201");
  stir(node);
}

TEST_CASE("PDO state: no PDO is processed after leaving Operational for either state [N3] [N11]") {
  for (const char* command : {"000#8001", "000#0201", "000#8201", "000#8101"}) {
    CAPTURE(std::string(command));
    SyncNode node(all_kinds());
    node.start();
    node.rx("080#");
    node.frames();
    node.rx("301#72");
    node.trigger(0);
    node.trigger(0);
    node.trigger(2);
    node.frames();
    node.rx(command);
    node.frames();
    stir(node);
  }
}

TEST_CASE("PDO state: entering Operational again has the effect of the first time, from every state [N11]") {
  const auto play = [](SyncNode& node) {
    std::vector<std::string> all;
    const auto note = [&] {
      for (const std::string& line : node.trace()) all.push_back(line);
    };
    node.rx("080#");
    note();
    node.rx("481#R");
    note();
    node.after(350ms);
    note();
    node.trigger(0);
    note();
    node.rx("080#");
    note();
    return all;
  };
  SyncNode fresh(all_kinds());
  fresh.start();
  const std::vector<std::string> expected = play(fresh);
  CHECK(expected.size() >= 5);
  for (const char* command : {"000#8001", "000#0201"}) {
    CAPTURE(std::string(command));
    SyncNode node(all_kinds());
    node.start();
    node.trigger(0);
    node.trigger(0);
    node.frames();
    node.rx("301#21");
    node.after(33ms);
    node.rx(command);
    node.after(77ms);
    node.silent();
    node.rx("000#0101");
    node.after(0ms);
    CHECK(play(node) == expected);
  }
}

TEST_CASE("PDO state: commands to the present state change nothing [N7]") {
  SyncNode node(all_kinds());
  node.start();
  node.rx("080#");
  node.tx({"281#31", "381#41"});
  node.rx("301#72");
  node.trigger(0);
  node.tx("181#11");
  node.trigger(0);
  node.after(90ms);
  node.rx("000#0101");
  node.silent();
  node.rx("080#");
  node.tx("281#31");
  CHECK(node.u8[1] == 0x72);
  node.after(150ms);
  node.tx_at(110ms, "181#11");  // the inhibit time continues outside of Operational
}

TEST_CASE("PDO state: leaving Operational withdraws queued TPDOs and no other frames [N3]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    CAPTURE(std::string(command));
    SyncNode node(all_kinds(), [](Setup& setup) { setup.heartbeat(1000); });
    node.start();
    node.can.refuse_all();
    node.rx("080#");
    node.trigger(0);
    node.after(1000ms);
    CHECK(node->TxQueue.Num == 4);
    node.rx(command);
    node.can.accept_all();
    node.loop();
    node.tx("701#05");
    CHECK(node.counters().Dropped == 3);
  }
}

TEST_CASE("PDO state: a reset withdraws queued TPDOs; no earlier frame follows the boot-up [N3] [T14]") {
  for (const char* command : {"000#8101", "000#8201"}) {
    SyncNode node(all_kinds());
    node.start();
    node.can.refuse_all();
    node.rx("080#");
    node.trigger(0);
    node.rx(command);
    node.can.accept_all();
    node.loop();
    node.tx("701#00");
    node.after(1000ms);
    node.silent();
  }
}

TEST_CASE("PDO state: a stop of the node leaves no timer and no frame") {
  SyncTable table = all_kinds();
  table.sync_id = 0x40000080;
  table.cycle = 10000;
  table.window = 5000;
  table.rpdo[0].event = 100;
  SyncNode node(table);
  node.start();
  node.rx("201#01");
  node.after(12ms);
  node.frames();
  node.call([&] { CONodeStop(&node.node); });
  CHECK(node.armed_timers() == 0);
  node.after(1000ms);
  node.silent();
  CHECK(node.request(0) == CO_ERR_NMT_MODE);
  node.silent();
}

TEST_CASE("PDO state: before CONodeStart no PDO is processed and no timer runs [N3]") {
  SyncTable table = all_kinds();
  table.sync_id = 0x40000080;
  table.cycle = 10000;
  SyncNode node(table, [](Setup& setup) { setup.stay_in_init(); });
  CHECK(node.armed_timers() == 0);
  CHECK(node.request(0) == CO_ERR_NMT_MODE);
  node.after(100ms);
  node.silent();
}

TEST_CASE("PDO state: bus-off withdraws synchronous TPDOs, not event-driven ones [Q5]") {
  SyncNode node(all_kinds());
  node.start();
  node.can.refuse_all();
  node.rx("080#");
  node.trigger(0);
  CHECK(node->TxQueue.Num == 3);
  node.call([&] { CONodeCanEvent(&node.node, CO_CAN_BUS_OFF); });
  CHECK(node->TxQueue.Num == 0);  // the default of 1029h enters Pre-operational, in which PDOs are not sent
  CHECK(node.mode() == CO_PREOP);
  node.can.accept_all();
  node.loop();
  node.silent();
}

}  // namespace

#endif
