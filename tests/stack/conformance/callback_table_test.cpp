// SPDX-License-Identifier: Apache-2.0
// CO_NODE_EXT.Callbacks: each function of the table is called with node and User, in place of the C function. [Q9]
#include "support/lss_slave.hpp"
#include "support/parameter_groups.hpp"
#include "support/sync_fixture.hpp"
#include "support/time_fixture.hpp"

#if USE_CALLBACKS

namespace {

using namespace test;
using Seen = std::vector<std::string>;

Seen seen;

// Records a call.
void note(CO_NODE_T* node, const void* user, std::string_view text) {
  const OutsideStack outside;
  CHECK(user == CONodeGetUser(node));
  seen.emplace_back(text);
}
void note(CO_NODE_T* node, const void* user, std::string_view text, unsigned number) {
  const OutsideStack outside;
  note(node, user, std::string(text) + " " + std::to_string(number));
}

Seen calls() { return std::exchange(seen, {}); }

// Returns a table with every function.
CO_CALLBACKS complete() {
  CO_CALLBACKS table{};
  table.ModeChange = [](CO_NODE_T* node, void* user, CO_MODE mode) { note(node, user, "mode", mode); };
  table.ResetRequest = [](CO_NODE_T* node, void* user, CO_NMT_RESET reset) { note(node, user, "reset", reset); };
  table.HbConsEvent = [](CO_NODE_T* node, void* user, std::uint8_t id) { note(node, user, "missing", id); };
  table.HbConsChange = [](CO_NODE_T* node, void* user, std::uint8_t id, CO_MODE mode) {
    const OutsideStack outside;
    note(node, user, "state of " + std::to_string(id), mode);
  };
  table.LifeGuardEvent = [](CO_NODE_T* node, void* user, bool occurred) { note(node, user, "life", occurred ? 1 : 0); };
  table.CanReceive = [](CO_NODE_T* node, void* user, CO_IF_FRM* frm) {
    const OutsideStack outside;
    note(node, user, notation(*frm));
  };
  table.CanChange = [](CO_NODE_T* node, void* user, CO_CAN_EVENT event) { note(node, user, "CAN", event); };
  table.PdoTransmit = [](CO_NODE_T* node, void* user, CO_IF_FRM* frm) {
    const OutsideStack outside;
    note(node, user, "TPDO " + notation(*frm));
  };
  table.PdoReceive = [](CO_NODE_T* node, void* user, CO_IF_FRM* frm) {
    const OutsideStack outside;
    note(node, user, "RPDO " + notation(*frm));
    return std::int16_t{0};
  };
  table.PdoSyncUpdate = [](CO_NODE_T* node, void* user, CO_RPDO*) { note(node, user, "written at SYNC"); };
  table.PdoUpdate = [](CO_NODE_T* node, void* user, CO_RPDO*) { note(node, user, "written"); };
  table.ParaDefault = [](CO_NODE_T* node, void* user, CO_PARA*) {
    note(node, user, "defaults");
    return std::int16_t{0};
  };
  table.ParaLost = [](CO_NODE_T* node, void* user, const CO_PARA*) { note(node, user, "lost"); };
  table.LssLoad = [](CO_NODE_T* node, void* user, std::uint32_t*, std::uint8_t*) {
    note(node, user, "load");
    return CO_ERR_NONE;
  };
  table.LssStore = [](CO_NODE_T* node, void* user, std::uint32_t baud, std::uint8_t id) {
    const OutsideStack outside;
    note(node, user, "store " + std::to_string(baud), id);
    return CO_ERR_NONE;
  };
  table.TimeUpdate = [](CO_NODE_T* node, void* user, const CO_TIME_OF_DAY* time) {
    note(node, user, "time", time->Ms);
  };
  table.LedChange = [](CO_NODE_T* node, void* user, std::uint8_t leds) { note(node, user, "LEDs", leds); };
  table.EmcyReceived = [](CO_NODE_T* node, void* user, std::uint8_t id, std::uint16_t code, std::uint8_t reg,
                          const std::uint8_t* msef) {
    const OutsideStack outside;
    note(node, user, "EMCY " + std::to_string(id) + " " + std::to_string(code) + " " + std::to_string(reg), msef[4]);
  };
  return table;
}

const CO_CALLBACKS table = complete();

Setup with_table(Setup setup = Setup()) { return setup.callbacks(table); }

TEST_CASE("callback table: NMT states and resets") {
  Fixture node(with_table());
  callbacks().mode_change = [](CO_NMT*, CO_MODE) { FAIL_CHECK("the C function is called"); };
  callbacks().reset_request = [](CO_NMT*, CO_NMT_RESET) { FAIL_CHECK("the C function is called"); };
  calls();
  node.rx("000#0101");
  CHECK(calls() == Seen{"mode 3"});
  node.ask("000#8201", "701#00");
  const Seen after_reset = calls();
  REQUIRE(!after_reset.empty());
  CHECK(after_reset.back() == "reset " + std::to_string(CO_RESET_COM));
}

TEST_CASE("callback table: frames without a consumer, and events of the controller") {
  Fixture node(with_table());
  callbacks().can_receive = [](CO_IF_FRM*) { FAIL_CHECK("the C function is called"); };
  callbacks().can_change = [](CO_NODE*, CO_CAN_EVENT) { FAIL_CHECK("the C function is called"); };
  calls();
  node.rx("123#0102");
  CHECK(calls() == Seen{"123#0102"});
  node.call([&] { CONodeCanEvent(node.operator->(), CO_CAN_OVERRUN); });
  CHECK(calls() == Seen{"CAN 0"});
  node.trace();
}

TEST_CASE("callback table: a null entry leaves the call to the C function, for each entry alone") {
  CO_CALLBACKS part = complete();
  part.CanReceive = nullptr;
  Setup setup;
  Fixture node(setup.callbacks(part));
  callbacks().can_receive = [](CO_IF_FRM* frm) { seen.push_back("C " + notation(*frm)); };
  calls();
  node.rx("123#01");
  CHECK(calls() == Seen{"C 123#01"});
  node.rx("000#0101");
  CHECK(calls() == Seen{"mode 3"});
}

TEST_CASE("callback table: two nodes with different tables, the second without one") {
  Fixture first(with_table());
  calls();
  first.rx("123#01");
  CHECK(calls() == Seen{"123#01"});
  Fixture second;
  second.rx("123#02");
  CHECK(calls().empty());
  first.rx("123#03");
  CHECK(calls() == Seen{"123#03"});
}

#if CO_HBCONS_N > 0
TEST_CASE("callback table: heartbeats of other nodes [H1]") {
  CO_HBCONS consumer{};
  consumer.Time = 100;
  consumer.NodeId = 5;
  Fixture node(with_table(Setup()
                              .with({CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, 1})
                              .with({CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, &consumer})));
  callbacks().heartbeat_change = [](CO_NMT*, std::uint8_t, CO_MODE) { FAIL_CHECK("the C function is called"); };
  callbacks().heartbeat_event = [](CO_NMT*, std::uint8_t) { FAIL_CHECK("the C function is called"); };
  calls();
  node.rx("705#7F");
  CHECK(calls() == Seen{"state of 5 2"});
  node.after(100ms);
  CHECK(calls() == Seen{"missing 5"});
  node.trace();
}
#endif

#if USE_GUARDING
TEST_CASE("callback table: life guarding") {
  Fixture node(with_table(Setup()
                              .without(0x1014, 0)
                              .with({CO_KEY(0x100C, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, 100})
                              .with({CO_KEY(0x100D, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2})));
  callbacks().life_guard = [](CO_NMT*, bool) { FAIL_CHECK("the C function is called"); };
  calls();
  node.ask("701#R", "701#7F");
  node.after(200ms);
  CHECK(calls() == Seen{"life 1"});
  node.trace();
  node.rx("701#R");
  CHECK(calls() == Seen{"life 0"});
  node.trace();
}
#endif

#if CO_TPDO_N > 1 && CO_RPDO_N > 1 && USE_SYNC
TEST_CASE("callback table: its functions are called for event-driven and synchronous PDOs in place of C functions") {
  SyncTable entries;
  entries.rpdo[0].on(0x201, 255, {0x22010108});
  entries.rpdo[1].on(0x301, 1, {0x22010208});
  entries.tpdo[0].on(0x40000181, 255, {0x22010108});
  SyncNode node(entries, [](Setup& setup) { setup.callbacks(table); });
  callbacks().pdo_transmit = [](CO_IF_FRM*) { FAIL_CHECK("the C function is called"); };
  callbacks().pdo_receive = [](CO_IF_FRM*) -> std::int16_t {
    FAIL("the C function is called");
    return 0;
  };
  callbacks().pdo_update = [](CO_RPDO*) { FAIL_CHECK("the C function is called"); };
  callbacks().pdo_sync_update = [](CO_RPDO*) { FAIL_CHECK("the C function is called"); };
  node.start();
  calls();
  node.rx("201#07");
  CHECK(calls() == Seen{"RPDO 201#07", "written"});
  node.rx("301#08");
  CHECK(calls() == Seen{"RPDO 301#08"});
  node.rx("080#");
  CHECK(calls() == Seen{"written at SYNC", "written"});
  node.trigger(0);
  CHECK(calls() == Seen{"TPDO 181#07"});
  node.trace();
}
#endif

#if USE_PARA
TEST_CASE("callback table: default values of a parameter group, and a record that is lost") {
  GroupDevice device;
  Fixture node(device.setup().callbacks(table));
  callbacks().para_default = [](CO_PARA*) -> std::int16_t {
    FAIL("the C function is called");
    return 0;
  };
  callbacks().para_lost = [](CO_NODE*, const CO_PARA*) { FAIL_CHECK("the C function is called"); };
  node.ask("601#231110026C6F6164", "581#6011100200000000");
  calls();
  node.ask("000#8101", "701#00");
  const Seen after_reset = calls();
  CHECK(std::count(after_reset.begin(), after_reset.end(), "defaults") == 1);
}
#endif

#if USE_LSS
TEST_CASE("callback table: node-ID and bit rate of LSS") {
  Setup setup;
  Fixture node(with_table(with_lss_address(setup)));
  callbacks().lss_store = [](std::uint32_t, std::uint8_t) -> CO_ERR {
    FAIL("the C function is called");
    return CO_ERR_NONE;
  };
  const Seen at_start = calls();
  CHECK(std::count(at_start.begin(), at_start.end(), "load") == 1);
  node.rx(lss_to_configuration);
  node.ask("7E5#1107000000000000", "7E4#1100000000000000");
  node.ask("7E5#1700000000000000", "7E4#1700000000000000");
  CHECK(calls() == Seen{"store 250000 7"});
}
#endif

#if USE_TIME
TEST_CASE("callback table: TIME") {
  TimeNode node(time_consumer, with_table());
  callbacks().time_update = [](CO_NODE*, const CO_TIME_OF_DAY*) { FAIL_CHECK("the C function is called"); };
  calls();
  node.rx("100#0A0000000100");
  CHECK(calls() == Seen{"time 10"});
}
#endif

#if USE_LED
TEST_CASE("callback table: status LEDs") {
  Fixture node(with_table());
  callbacks().led_change = [](CO_NODE*, std::uint8_t) { FAIL_CHECK("the C function is called"); };
  calls();
  node.call([&] { COLedStart(node.operator->()); });
  const Seen shown = calls();
  REQUIRE(shown.size() == 1);
  CHECK(shown[0].substr(0, 5) == "LEDs ");
}
#endif

#if CO_EMCY_CONS_N > 1
TEST_CASE("callback table: EMCY messages of other nodes") {
  Fixture node(with_table(Setup()
                              .with({CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2})
                              .with({CO_KEY(0x1028, 1, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x80000000})
                              .with({CO_KEY(0x1028, 2, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x82})));
  callbacks().emcy_received = [](CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
    FAIL_CHECK("the C function is called");
  };
  calls();
  node.rx("082#0010810000000009");
  CHECK(calls() == Seen{"EMCY 2 4096 129 9"});
}
#endif

}  // namespace

#endif
