// SPDX-License-Identifier: Apache-2.0
// PDOs and SYNC when the controller refuses frames. [T12] [Q4]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 2 && CO_RPDO_N > 0 && USE_SYNC

namespace {

using namespace test;

SyncTable table_of() {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22110108});
  table.tpdo[0].on(0x40000181, 255, {0x22110108});
  table.tpdo[1].on(0x40000281, 1, {0x22010208});
  table.tpdo[2].on(0x40000381, 255, {0x22010308}).event = 100;
  table.sync_id = 0x40000080;
  table.cycle = 50000;
  return table;
}

// Runs a session of events, SYNC production, event timers, RPDOs and SDO. Returns the sent frames, sorted.
std::vector<std::string> session(SyncNode& node) {
  std::vector<std::string> all;
  const auto collect = [&] {
    for (int i = 0; i < 4; ++i) node.loop();
    for (const std::string& sent : node.frames()) all.push_back(sent);
  };
  node.rx("000#0101");
  collect();
  for (const char* text : {"201#42", "601#4000100000000000", "201#43", "201#"}) {
    node.rx(text);
    collect();
  }
  node.rx("201#43");
  collect();
  for (int i = 0; i < 3; ++i) {
    node.after(50ms);
    collect();
  }
  node.rx("000#8001");
  collect();
  std::sort(all.begin(), all.end());
  return all;
}

TEST_CASE("PDO send failure: no PDO is lost, whichever frames the driver refuses [T12]") {
  SyncNode undisturbed(table_of());
  const std::vector<std::string> expected = session(undisturbed);
  CHECK(expected.size() == 5 + 3 + 3 + 1);
  for (const std::int16_t refusal : std::initializer_list<std::int16_t>{std::int16_t{0}, std::int16_t{-1}}) {
    for (const std::uint64_t times : std::initializer_list<std::uint64_t>{1U, 2U, 3U}) {
      for (std::uint64_t n = 1; n <= expected.size(); ++n) {
        CAPTURE(refusal);
        CAPTURE(times);
        CAPTURE(n);
        SyncNode node(table_of());
        node.frames_per_call(16);
        node.can.refuse_nth(n, refusal);
        node.can.refuse_to += times - 1;
        CHECK(session(node) == expected);  // session() sorts the frames
        CHECK(node.counters().Dropped == 0);
      }
    }
  }
}

TEST_CASE("PDO send failure: a queued TPDO is replaced by its newer values [T12]") {
  SyncNode node(table_of());
  node.frames_per_call(16);
  node.start();
  node.can.refuse_all();
  for (std::uint8_t value = 1; value <= 100; ++value) {
    node.rx(CO_IF_FRM{0x201, {value}, 1});
  }
  CHECK(node->TxQueue.Num == 1);
  node.can.accept_all();
  node.loop();
  node.tx("181#64");
}

TEST_CASE("PDO send failure: at most one SYNC, the newest, is queued, before the PDOs [T12] [Q4]") {
  SyncTable table = table_of();
  table.counter = 10;
  table.tpdo[2].event = 0;
  SyncNode node(table);
  node.frames_per_call(16);
  node.start();
  node.can.refuse_all();
  node.after(170ms);
  CHECK(node->TxQueue.Num == 2);
  node.can.accept_all();
  node.loop();
  node.tx({"080#03", "281#21"});
}

TEST_CASE("PDO send failure: SDO answers, EMCY and heartbeats are queued although TPDOs fill their part [T12] [Q4]") {
  for (const std::uint16_t queue : std::initializer_list<std::uint16_t>{1, 2, 4, 8, 32}) {
    CAPTURE(queue);
    SyncTable table = table_of();
    table.cycle = 0;
    table.sync_id = 0x80;
    SyncNode node(table, [&](Setup& setup) { setup.tx_queue(queue).heartbeat(1000); });
    node.frames_per_call(40);
    node.start();
    node.can.refuse_all();
    node.rx("201#42");
    node.rx("080#");
    node.trigger(2);
    CO_IF_FRM other = frame("7E0#");
    for (int i = 0; i < 40; ++i) {
      node.call([&] { COIfCanSend(&node->If, &other); });
    }
    const std::uint32_t lost = node.counters().Dropped;
    node.rx("601#4000100000000000");
    if (queue >= 4) {
      CHECK(node.counters().Dropped == lost);
    }
    node.can.accept_all();
    node.loop();
    const std::vector<std::string> sent = node.frames();
    if (queue >= 4) {
      CHECK(std::count(sent.begin(), sent.end(), "581#4300100091010F00") == 1);
    }
    node.rx("000#8001");
    node.frames();
  }
}

TEST_CASE("PDO send failure: TPDOs that a full queue refuses are counted and sent with the next event [T12] [X12]") {
  SyncNode node(table_of(), [](Setup& setup) { setup.tx_queue(2); });
  node.frames_per_call(16);
  node.start();
  node.can.refuse_all();
  CO_IF_FRM other = frame("7E0#");
  for (int i = 0; i < 3; ++i) {
    node.call([&] { COIfCanSend(&node->If, &other); });
  }
  const std::uint32_t lost = node.counters().Dropped;
  node.rx("201#42");
  CHECK(node.counters().Dropped == lost + 1);
  CHECK(node.request(0) == CO_ERR_IF_CAN_SEND);
  CHECK(node.counters().Dropped == lost + 2);
  node.can.accept_all();
  node.loop();
  node.frames();
  node.rx("201#43");
  node.tx("181#43");
}

TEST_CASE("PDO send failure: type 0 that a full queue refuses is sent with the next SYNC [X1] [T12]") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 0, {0x22110108});
  SyncNode node(table, [](Setup& setup) { setup.tx_queue(1); });
  node.start();
  node.can.refuse_all();
  CO_IF_FRM other = frame("7E0#");
  node.call([&] { COIfCanSend(&node->If, &other); });
  node.rx("080#");
  node.can.accept_all();
  node.loop();
  node.tx("7E0#");
  node.rx("080#");
  node.tx("181#11");
  node.rx("080#");
  node.silent();
}

TEST_CASE("PDO send failure: an empty queue requires no deadline") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 255, {0x22110108});
  SyncNode node(table);
  node.start();
  node.can.refuse_all();
  node.trigger(0);
  CHECK(CONodeNextDeadline(&node.node) == 1);
  node.can.accept_all();
  node.after(1ms);
  node.loop();
  node.tx("181#11");
  CHECK(CONodeNextDeadline(&node.node) == 0xFFFFFFFF);
}

}  // namespace

#endif
