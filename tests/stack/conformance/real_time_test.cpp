// SPDX-License-Identifier: Apache-2.0
// CONodeRealTime(): SYNC and PDOs in one thread, all other services in another.
#include <utility>

#include "support/failing_nvm.hpp"
#include "support/real_time_fixture.hpp"

#if USE_REAL_TIME && USE_SYNC && CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

SyncTable pdos() {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010308});
  table.rpdo[1].on(0x301, 1, {0x22010208});
  table.tpdo[1].on(0x40000281, 1, {0x22010408});
  return table;
}

std::uint64_t waiting(const RealTimeNode& node) { return CORingCount(&node.ring); }

TEST_CASE("real time: CONodeRealTime processes RPDOs and SYNC and reads all frames; CONodeProcess reads none") {
  RealTimeNode node(pdos());
  node.start();
  for (const char* text : {"201#AA", "301#BB", "080#"}) node.arrive(text);
  node.mainline();
  CHECK(node.u8[0] == 0x11);
  node.silent();
  node.real_time();
  node.tx("281#41");
  CHECK(node.u8[0] == 0xAA);
  CHECK(node.u8[1] == 0xBB);
  CHECK(waiting(node) == 0);
  CHECK(node.counters().Received == 4);
}

TEST_CASE("real time: frames of other services are stored for CONodeProcess in their order") {
  RealTimeNode node(pdos(), [](Setup& setup) { setup.foreign(); });
  for (const char* text : {"601#4000100000000000", "000#0101", "601#4001100000000000", "123#"}) node.arrive(text);
  node.real_time();
  node.silent();
  CHECK(node.mode() == CO_PREOP);
  CHECK(waiting(node) == 4);
  node.call([&] { CONodeProcess(&node.node); });
  node.tx("581#4300100091010F00");
  CHECK(node.mode() == CO_PREOP);
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(node.mode() == CO_OPERATIONAL);
  node.mainline();
  node.tx("581#4F01100000000000");
  CHECK(node.counters().Received == 4);
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("real time: unrelated frames are not stored in the ring") {
  RealTimeNode node(pdos());
  unsigned seen = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++seen; };
  for (int n = 0; n < 20; ++n) node.arrive("123#");
  node.arrive("601#4000100000000000");
  for (const char* text : {"602#4000100000000000", "123#R", "00012345#"}) node.arrive(text);
  node.real_time();
  CHECK(waiting(node) == 1);
  CHECK(node.counters().Unclaimed == 23);
  node.mainline();
  node.tx("581#4300100091010F00");
  CHECK(seen == 0);
  CHECK(node.counters().Received == 24);
  CHECK(node.counters().CanEvents[CO_CAN_OVERRUN] == 0);
}

TEST_CASE("real time: COIfCanReceive() gets unrelated frames in the mainline if the node is configured for it") {
  RealTimeNode node(pdos(), [](Setup& setup) { setup.foreign(); });
  std::vector<std::string> seen;
  callbacks().can_receive = [&](CO_IF_FRM* frm) { seen.push_back(notation(*frm)); };
  for (const char* text : {"123#", "201#AA", "602#40", "00012345#"}) node.arrive(text);
  node.real_time();
  CHECK(seen.empty());
  CHECK(waiting(node) == 3);
  node.mainline();
  CHECK(seen == std::vector<std::string>{"123#", "602#40", "00012345#"});
  CHECK(node.counters().Unclaimed == 4);
}

TEST_CASE("real time: a PDO that the NMT state forbids is lost and never processed after a newer one") {
  RealTimeNode node(pdos());
  for (const char* text : {"000#0101", "201#AA"}) node.arrive(text);
  node.real_time();
  CHECK(node.counters().Unclaimed == 1);
  CHECK(waiting(node) == 1);
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(node.mode() == CO_OPERATIONAL);
  node.arrive("201#BB");
  node.real_time();
  CHECK(node.u8[0] == 0xBB);
  node.mainline();
  CHECK(node.u8[0] == 0xBB);
}

TEST_CASE("real time: CONodeNextDeadline is 0 while frames or a reset are pending for the mainline") {
  RealTimeNode node(pdos());
  node.start();
  CHECK(CONodeNextDeadline(&node.node) != 0);
  node.arrive("601#4000100000000000");
  node.real_time();
  CHECK(CONodeNextDeadline(&node.node) == 0);
  node.mainline();
  node.tx("581#4300100091010F00");
  CHECK(CONodeNextDeadline(&node.node) != 0);
  callbacks().pdo_update = [&](CO_RPDO*) { CONmtReset(&node->Nmt, CO_RESET_COM); };
  node.arrive("201#AA");
  node.real_time();
  CHECK(CONodeNextDeadline(&node.node) == 0);
  node.mainline();
  node.tx("701#00");
}

TEST_CASE("real time: a stopped node discards pending frames and has no deadline") {
  RealTimeNode node(pdos());
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) { CONodeStop(&node.node); };
  for (const char* text : {"601#4000100000000000", "201#AA"}) node.arrive(text);
  node.real_time();
  CHECK(node.mode() == CO_INVALID);
  CHECK(waiting(node) == 0);
  node.mainline();
  node.silent();
}

#if CO_EMCY_CONS_N >= 2
TEST_CASE("real time: a CAN-ID that a PDO shares with another service is processed by the mainline") {
  SyncTable table;
  table.rpdo[0].on(0x301, 255, {0x22010108});
  RealTimeNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2});
    setup.with({CO_KEY(0x1028, 1, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x80000000});
    setup.with({CO_KEY(0x1028, 2, CO_OBJ_D___RW), CO_TEMCY_CONS, 0x301});
  });
  unsigned emergencies = 0;
  callbacks().emcy_received = [&](CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*) {
    ++emergencies;
  };
  node.start();
  node.arrive("301#3412050000000000");
  node.real_time();
  CHECK(emergencies == 0);
  CHECK(node.u8[0] == 0x11);
  node.mainline();
  CHECK(emergencies == 1);
  CHECK(node.u8[0] == 0x34);
  node.frames();
}

#endif

TEST_CASE("real time: 29-bit identifiers, remote frames and a DLC above 8 are handled") {
  SyncTable table;
  table.rpdo[0].on(0x20012345, 255, {0x22080140});
  table.tpdo[0].on(0x181, 253, {0x22010308});
  RealTimeNode node(table);
  node.start();
  CO_IF_FRM frm = frame("00012345#0102030405060708");
  frm.DLC = 15;
  node.can.to_node.push_back(frm);
  if (USE_PDO_RTR != 0) {
    node.arrive("181#R");
  }
  node.real_time();
  CHECK(node.u64[0] == 0x0807060504030201);
  if (USE_PDO_RTR != 0) {
    node.tx("181#31");
  }
  CHECK(waiting(node) == 0);
  node.mainline();
  node.frames();
}

TEST_CASE("real time: a frame with a DLC above 15 is counted and dropped before the ring") {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22080140});
  RealTimeNode node(table, [](Setup& setup) { setup.foreign(); });
  unsigned passed_on = 0;
  callbacks().can_receive = [&](CO_IF_FRM*) { ++passed_on; };
  node.start();
  const std::uint64_t before = node.u64[0];
  const std::uint32_t malformed = node.counters().Malformed;
  for (const char* const text : {"201#0102030405060708", "601#4000100000000000", "123#00", "20000040#0000"}) {
    CO_IF_FRM frm = frame(text);
    frm.DLC = 16;
    node.can.to_node.push_back(frm);
  }
  node.real_time();
  CHECK(waiting(node) == 0);
  node.mainline();
  node.silent();
  CHECK(node.counters().Malformed == malformed + 4);
  CHECK(node.u64[0] == before);
  CHECK(passed_on == 0);
}

TEST_CASE("real time: events of the controller are processed by CONodeProcess") {
  RealTimeNode node(pdos());
  unsigned events = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++events; };
  CO_IF_FRM report{};
  report.Identifier = CO_IF_FRM_ERROR | 0x40;
  report.DLC = 8;
  node.can.to_node.push_back(report);
  node.real_time();
  CHECK(events == 0);
  node.mainline();
  CHECK(events == 1);
  node.frames();
}

TEST_CASE("real time: frames lost by a full ring are reported once by CONodeProcess") {
  RealTimeNode node(pdos());
  unsigned events = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT event) { events += event == CO_CAN_OVERRUN ? 1U : 100U; };
  for (int n = 0; n < 8; ++n) node.arrive("000#0102");
  node.real_time();
  CHECK(CORingLost(&node.ring) == 0);
  node.arrive("000#0102");
  node.arrive("000#0102");
  node.real_time();
  CHECK(CORingLost(&node.ring) == 2);
  node.call([&] {
    COTmrProcess(&node->Tmr);
    CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2201, 1), 7) == CO_ERR_NONE);
  });
  CHECK(events == 0);
  CHECK(node.counters().CanEvents[CO_CAN_OVERRUN] == 0);
  node.silent();
  CHECK(CONodeNextDeadline(&node.node) == 0);
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(node.frames() == reports({emcy(0x8110)}));
  CHECK(events == 1);
  CHECK(node.counters().CanEvents[CO_CAN_OVERRUN] == 1);
  CHECK(waiting(node) == 7);
  node.mainline();
  CHECK(events == 1);
  node.real_time();
  node.mainline();
  CHECK(events == 1);
  node.frames();
}

TEST_CASE("real time: a pending overrun and a pending reset are both processed; a stopped node has neither") {
  RealTimeNode node(pdos());
  node.start();
  unsigned events = 0;
  callbacks().can_change = [&](CO_NODE*, CO_CAN_EVENT) { ++events; };
  callbacks().pdo_update = [&](CO_RPDO*) { CONmtReset(&node->Nmt, CO_RESET_COM); };
  const auto lose = [&] {
    for (int n = 0; n < 9; ++n) node.arrive("000#0102");
    node.arrive("201#AA");
    node.real_time();
  };
  lose();
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(events == 1);
  CHECK(node.mode() == CO_PREOP);
  CHECK(node.frames().back() == "701#00");
  node.start();
  lose();
  node.call([&] {
    CONodeStop(&node.node);
    CONodeProcess(&node.node);
  });
  CHECK(CONodeNextDeadline(&node.node) != 0);
  node.silent();
}

TEST_CASE("real time: COPdoTransmit is called by the thread of the event: SYNC and timers, or mainline") {
  SyncTable table = pdos();
  table.tpdo[2].on(0x40000381, 255, {0x22110108});
  RealTimeNode node(table);
  node.start();
  unsigned sent = 0;
  callbacks().pdo_transmit = [&](CO_IF_FRM*) { ++sent; };
  node.arrive("080#");
  node.real_time();
  CHECK(sent == 1);
  node.may_change(0x2211, 1);
  node.arrive("601#2F11220155000000");
  node.real_time();
  CHECK(sent == 1);
  node.mainline();
  CHECK(sent == 2);
  CHECK(node.frames().size() == 3);
}

TEST_CASE("real time: CONodeRealTime runs the timers of the SYNC producer and the window [301:7.2.5]") {
  SyncTable table = pdos();
  table.sync_id = 0x40000080;
  table.cycle = 10000;
  table.window = 4000;
  RealTimeNode node(table);
  node.start();
  node.pass(10ms);
  node.mainline();
  node.silent();
  node.real_time();
  node.tx({"080#", "281#41"});
  node.pass(4ms);
  CHECK(node->WindowOver == 0);
  node.mainline();
  CHECK(node->WindowOver == 0);
  node.real_time();
  CHECK(node->WindowOver == 1);
}

TEST_CASE("real time: CONodeRealTime runs event timer, inhibit time and deadline of PDOs [301:7.2.2.6]") {
  SyncTable table = pdos();
  table.tpdo[0].event = 20;
  table.tpdo[0].inhibit = 50;
  table.rpdo[0].event = 30;
  RealTimeNode node(table);
  node.start();
  node.trigger(0);
  node.tx("181#31");
  node.trigger(0);
  node.arrive("201#AA");
  node.real_time();
  node.pass(5ms);
  node.mainline();
  node.silent();
  node.real_time();
  node.tx("181#31");
  node.pass(5ms);
  node.real_time();
  node.silent();
  node.pass(15ms);
  node.mainline();
  node.silent();
  node.real_time();
  node.tx("181#31");
  node.pass(5ms);
  node.mainline();
  node.silent();
  node.real_time();
  CHECK(node.frames() == reports({emcy(0x8250, 1)}));
}

TEST_CASE("real time: COTmrProcess() runs all other timers in their order") {
  SyncTable table = pdos();
  table.tpdo[0].event = 1;
  RealTimeNode node(table, [](Setup& setup) { setup.heartbeat(3); });
  node.start();
  node.frames();
  static std::vector<int> runs;
  runs.clear();
  const auto note_number = [](void* number) {
    const OutsideStack outside;
    runs.push_back(*static_cast<int*>(number));
  };
  static int numbers[] = {1, 2, 3};
  node.call([&] {
    for (int& number : numbers) {
      CHECK(COTmrCreate(&node->Tmr, static_cast<std::uint32_t>(number), 0, note_number, &number) >= 0);
    }
  });
  node.trigger(0);
  node.frames();
  node.pass(3ms);
  node.real_time();
  node.tx("181#31");
  CHECK(runs.empty());
  node.real_time();
  node.silent();
  node.mainline();
  node.tx("701#05");
  CHECK(runs == std::vector<int>{1, 2, 3});
}

TEST_CASE("real time: timers of PDOs do not depend on a late mainline") {
  SyncTable table = pdos();
  table.tpdo[0].event = 10;
  table.tpdo[2].on(0x40000381, 255, {0x22010508}).event = 10;
  RealTimeNode node(table);
  node.start();
  node.call([&] {
    const auto nothing = [](void*) {};
    CHECK(COTmrCreate(&node->Tmr, 2, 0, nothing, nullptr) >= 0);
  });
  node.trigger(0);
  node.tx("181#31");
  std::uint64_t now = 0;
  const auto serve_at = [&](std::uint64_t tick) {
    node.idle(std::chrono::milliseconds{tick - now});
    now = tick;
    node.real_time();
  };
  serve_at(2);
  node.trigger(2);
  node.tx("381#51");
  constexpr std::uint64_t round = 0x100000000;
  serve_at(round / 2 + 3);
  node.tx({"181#31", "381#51"});
  serve_at(round - 5);
  node.tx({"381#51", "181#31"});
  serve_at(round + 5);  // one timer expires within 2^32 ticks after the mainline's, one later
  node.tx({"381#51", "181#31"});
}

TEST_CASE("real time: CONodeNextDeadline ignores elapsed timers of the other thread") {
  SyncTable table = pdos();
  table.tpdo[0].event = 5;
  RealTimeNode node(table, [](Setup& setup) { setup.heartbeat(50); });
  node.start();
  node.mainline();
  node.trigger(0);
  node.frames();
  const auto deadline = [&] {
    std::uint32_t ticks = 0;
    node.call([&] { ticks = CONodeNextDeadline(&node.node); });
    return ticks;
  };
  CHECK(deadline() == 5);
  node.pass(5ms);
  CHECK(deadline() == 45);
  node.pass(45ms);
  CHECK(deadline() == 0);
  node.mainline();
  node.tx("701#05");
  node.real_time();
  node.frames();
}

TEST_CASE("real time: CONodeRealTime sends queued PDOs") {
  RealTimeNode node(pdos());
  node.start();
  node.can.refuse_all();
  node.trigger(0);
  node.can.accept_all();
  node.silent();
  node.real_time();
  node.tx("181#31");
}

TEST_CASE("real time: a reset that a callback of a PDO requests is carried out by CONodeProcess") {
  RealTimeNode node(pdos());
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) { CONmtReset(&node->Nmt, CO_RESET_COM); };
  node.arrive("201#AA");
  node.real_time();
  CHECK(node.mode() == CO_OPERATIONAL);
  node.mainline();
  CHECK(node.mode() == CO_PREOP);
  node.tx("701#00");
}

TEST_CASE("real time: only CONodeProcess carries out a reset, whatever functions the threads call meanwhile") {
  RealTimeNode node(pdos());
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) { CONmtReset(&node->Nmt, CO_RESET_COM); };
  node.arrive("201#AA");
  node.real_time();
  callbacks().pdo_update = nullptr;
  node.call([&] {
    CHECK(CODictWrByte(&node->Dict, CO_DEV(0x2201, 1), 7) == CO_ERR_NONE);
    CONodeCanEvent(&node.node, CO_CAN_RECOVERED);
    COTmrProcess(&node->Tmr);
#if USE_OD
    CHECK(OD_set_u16(OD_find(&node.od, 0x2202), 1, 8, false) == ODR_OK);
    CO_LOCK_OD(&node.node);
    CO_UNLOCK_OD(&node.node);
#endif
  });
  node.real_time();
  CHECK(node.mode() == CO_OPERATIONAL);
  node.silent();
  node.call([&] { CONodeProcess(&node.node); });
  CHECK(node.mode() == CO_PREOP);
  node.tx("701#00");
}

TEST_CASE(
    "real time: a reset that is requested outside of the two threads or by a timer is carried out by CONodeProcess") {
  RealTimeNode node(pdos());
  node.start();
  node.call([&] { CONmtReset(&node->Nmt, CO_RESET_NODE); });
  CHECK(node.mode() == CO_OPERATIONAL);
  CHECK(CONodeNextDeadline(&node.node) == 0);
  node.mainline();
  node.tx("701#00");
  node.call([&] {
    const auto reset = [](void* nmt) { CONmtReset(static_cast<CO_NMT*>(nmt), CO_RESET_COM); };
    CHECK(COTmrCreate(&node->Tmr, 5, 0, reset, &node->Nmt) >= 0);
  });
  node.elapse_only(5ms);
  node.call([&] { COTmrProcess(&node->Tmr); });
  node.silent();
  node.mainline();
  node.tx("701#00");
}

TEST_CASE("real time: a reset that is pending for CONodeProcess does not delay other work") {
  RealTimeNode node(pdos());
  node.start();
  node.may_change(0x1201, 1);
  node.may_change(0x1201, 2);
  node.call([&] {
    CONmtReset(&node->Nmt, CO_RESET_COM);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1201, 1), 0x241) == CO_ERR_NONE);
    CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1201, 2), 0x1C1) == CO_ERR_NONE);
  });
  CHECK(node->Sdo[1].RxId == 0x241);
  node.mainline();
  node.tx("701#00");
}

TEST_CASE("real time: a callback of a PDO that stops the node ends it at once") {
  RealTimeNode node(pdos());
  node.start();
  callbacks().pdo_update = [&](CO_RPDO*) { CONodeStop(&node.node); };
  for (const char* text : {"201#AA", "201#BB", "123#"}) node.arrive(text);
  node.real_time();
  CHECK(node.mode() == CO_INVALID);
  CHECK(node.u8[0] == 0xAA);
  CHECK(node.can.to_node.size() == 2);
  node.real_time();
  CHECK(node.can.to_node.size() == 1);  // each call discards one frame
  node.mainline();
  CHECK(node.can.to_node.empty());
  CHECK(node.u8[0] == 0xAA);
  node.silent();
}

TEST_CASE("real time: timers of the application run in a stopped node") {
  RealTimeNode node(pdos());
  node.start();
  static unsigned runs;
  runs = 0;
  const auto count = [](void*) { ++runs; };
  node.call([&] { CHECK(COTmrCreate(&node->Tmr, 10, 5, count, nullptr) >= 0); });
  node.call([&] { CONodeStop(&node.node); });
  for (int n = 0; n < 4; ++n) {
    node.idle(5ms);
    node.real_time();
    node.mainline();
  }
  CHECK(runs == 3);
  node.silent();
  node.arrive("201#AA");
  node.real_time();
  CHECK(node.u8[0] == 0x11);
  CHECK(node.can.to_node.empty());
}

TEST_CASE("real time: a reset discards stored frames, as the controller does") {
  RealTimeNode node(pdos());
  for (const char* text : {"000#8201", "601#4000100000000000"}) node.arrive(text);
  node.real_time();
  CHECK(waiting(node) == 2);
  node.mainline();
  node.tx("701#00");
  CHECK(waiting(node) == 0);
}

TEST_CASE("real time: without a ring CONodeRealTime does nothing and CONodeProcess everything") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 255, {0x22010308}).event = 5;
  PdoNode node(table, [](Setup& setup) { setup.turns(); });
  node.start();
  node.can.to_node.push_back(frame("201#AA"));
  node.call([&] { CONodeRealTime(&node.node); });
  CHECK(node.u8[0] == 0x11);
  node.loop();
  CHECK(node.u8[0] == 0xAA);
  node.trigger(0);
  node.tx("181#31");
  node.after(5ms);
  node.tx("181#31");
}

// Memory driver ------------------------------------------------------------------------------------------------------

std::function<void()> during_write;

TEST_CASE("real time: a state that is requested while the memory is written does not stop the reception of SYNC") {
  FailingNvm memory{{512, 4, 64}};
  CO_IF_NVM_DRV_EX driver = FailingNvm::driver;
  driver.Write = [](void* context, std::uint32_t start, const std::uint8_t* bytes, std::uint32_t size) {
    if (const auto action = std::exchange(during_write, nullptr)) action();
    return FailingNvm::driver.Write(context, start, bytes, size);
  };
  static std::uint32_t values[2] = {1, 2};
  CO_PARA group = {0,       sizeof values, reinterpret_cast<std::uint8_t*>(values), nullptr, CO_RESET_NODE,
                   nullptr, CO_PARA___E};
  RealTimeNode node({}, [&](Setup& setup) {
    setup.nvm(driver, &memory).with({CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, CO_DATA(&group)});
  });
  node.start();
  std::size_t left = 99;
  during_write = [&] {
    CONmtSetMode(&node->Nmt, CO_PREOP);
    node.can.to_node.push_back(frame("080#"));
    node.can.to_node.push_back(frame("080#"));
    CONodeRealTime(&node.node);
    left = node.can.to_node.size();
  };
  node.arrive("601#2310100173617665");
  node.real_time();
  node.mainline();
  CHECK(left == 0);
  CHECK(node.mode() == CO_PREOP);
  node.frames();
}

}  // namespace

#endif
