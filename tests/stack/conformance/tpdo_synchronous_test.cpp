// SPDX-License-Identifier: Apache-2.0
// Synchronous TPDOs: types 1 to 240, SYNC start value. [301:7.2.2.3, 7.5.2.37]
#include "support/sync_fixture.hpp"

#if CO_TPDO_N > 0 && USE_SYNC

namespace {

using namespace test;

SyncTable with(std::uint8_t type, std::uint8_t start = 0, std::uint8_t counter = 0) {
  SyncTable table;
  table.tpdo[0].on(0x40000181, type, {0x22010108}).start = start;
  table.counter = counter;
  return table;
}

// Sends SYNCs with the counter values first, first + 1, …. Returns the SYNCs, counted from 1, at which the PDO was
// sent.
std::vector<unsigned> sent_at(SyncNode& node, unsigned syncs, unsigned first = 1) {
  std::vector<unsigned> at;
  for (unsigned n = 1; n <= syncs; ++n) {
    const unsigned overflow = node.counter;
    CO_IF_FRM sync{0x80, {}, 0};
    if (overflow != 0) {
      sync.DLC = 1;
      sync.Data[0] = static_cast<std::uint8_t>((first + n - 2) % overflow + 1);
    }
    node.rx(sync);
    if (!node.can.sent.empty()) {
      at.push_back(n);
    }
    CHECK(node.frames().size() <= 1);
  }
  return at;
}

std::vector<unsigned> every(unsigned n, unsigned first, unsigned last) {
  std::vector<unsigned> all;
  for (unsigned at = first; at <= last; at += n) all.push_back(at);
  return all;
}

using List = std::vector<unsigned>;

TEST_CASE("synchronous TPDO: types 1 to 240 are sent with every n-th SYNC [X1] [PDO 06] [SYNC 03]") {
  for (unsigned type = 1; type <= 240; type += type < 5 ? 1 : stride(47)) {
    CAPTURE(type);
    SyncNode node(with(static_cast<std::uint8_t>(type)));
    node.start();
    CHECK(sent_at(node, 3 * type + 1) == every(type, type, 3 * type + 1));
  }
}

TEST_CASE("synchronous TPDO: the frame contains the values at the SYNC") {
  SyncNode node(with(2));
  node.start();
  node.u8[0] = 1;
  node.rx("080#");
  node.u8[0] = 2;
  node.silent();
  node.u8[0] = 3;
  node.rx("080#");
  node.tx("181#03");
}

TEST_CASE("synchronous TPDO: TPDOs contain the values before the RPDOs of the same SYNC [X3]") {
  if (CO_RPDO_N == 0) {
    return;
  }
  SyncTable table = with(1);
  table.rpdo[0].on(0x201, 1, {0x22010108});
  SyncNode node(table);
  node.start();
  node.rx("201#42");
  node.rx("080#");
  node.tx("181#11");
  CHECK(node.u8[0] == 0x42);
  node.rx("201#43");
  node.rx("080#");
  node.tx("181#42");
}

TEST_CASE("synchronous TPDO: all of one SYNC are sent in the order of their numbers, however they were switched on") {
  SyncTable table;
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    table.tpdo[n].on(0xC0000000U + 0x481 - n * 0x100, 1, {0x22010008U | (n + 1) << 8});
  }
  SyncNode node(table);
  node.start();
  for (unsigned n = fixture_tpdos; n-- > 0;) {
    REQUIRE(node.set(static_cast<std::uint16_t>(0x1800 + n), 1, 4, 0x40000481 - n * 0x100) == 0);
  }
  node.rx("080#");
  std::vector<std::string> expected;
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    expected.push_back(notation(CO_IF_FRM{0x481 - n * 0x100, {static_cast<std::uint8_t>(16 * (n + 1) + 1)}, 1}));
  }
  CHECK(node.frames() == expected);
}

TEST_CASE("synchronous TPDO: switching PDOs off and on neither skips nor repeats one") {
  SyncTable table;
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    table.tpdo[n].on(0x40000181 + n * 0x100, 1, {0x22010108});
  }
  SyncNode node(table);
  node.start();
  for (unsigned subset = 0; subset < 1U << fixture_tpdos; ++subset) {
    CAPTURE(subset);
    std::vector<std::string> expected;
    for (unsigned n = 0; n < fixture_tpdos; ++n) {
      const bool on = (subset >> n & 1U) != 0;
      const auto index = static_cast<std::uint16_t>(0x1800 + n);
      REQUIRE(node.set(index, 1, 4, (on ? 0x40000181 : 0xC0000181) + n * 0x100) == 0);
      if (on) {
        expected.push_back(notation(CO_IF_FRM{0x181 + n * 0x100, {0x11}, 1}));
      }
    }
    node.rx("080#");
    CHECK(node.frames() == expected);
  }
}

TEST_CASE("synchronous TPDO: SYNCs are counted since entering Operational [N11]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    SyncNode node(with(5));
    sent_at(node, 3);
    node.start();
    CHECK(sent_at(node, 8) == List{5});
    node.rx(command);
    CHECK(sent_at(node, 20).empty());
    node.rx("000#0101");
    CHECK(sent_at(node, 10) == List{5, 10});
  }
}

TEST_CASE("synchronous TPDO: SYNCs are counted since the PDO was switched on [P1]") {
  SyncNode node(with(5));
  node.start();
  CHECK(sent_at(node, 3).empty());
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(sent_at(node, 3).empty());
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(sent_at(node, 10) == List{5, 10});
}

TEST_CASE("synchronous TPDO: start in Operational does not change the count [N7]") {
  SyncNode node(with(5));
  node.start();
  CHECK(sent_at(node, 3).empty());
  node.rx("000#0101");
  CHECK(sent_at(node, 10) == List{2, 7});
}

TEST_CASE("synchronous TPDO: events do not send it [D42]") {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 1, {0x22110108});
  SyncNode node(table);
  node.start();
  node.trigger(0);
  node.call([&] { CODictWrByte(&node->Dict, CO_DEV(0x2211, 1), 0x77); });
  node.after(1000ms);
  node.silent();
  node.rx("080#");
  node.tx("181#77");
}

// Start value ---------------------------------------------------------------------------------------------------------

TEST_CASE("SYNC start value: the SYNC with this number counts as the first one [X14] [PDO 08]") {
  for (unsigned type : {1U, 2U, 3U, 10U}) {
    for (unsigned start : {1U, 2U, 7U, 10U}) {
      CAPTURE(type);
      CAPTURE(start);
      SyncNode node(with(static_cast<std::uint8_t>(type), static_cast<std::uint8_t>(start), 10));
      node.start();
      CHECK(sent_at(node, 45) == every(type, start + type - 1, 45));
    }
  }
}

TEST_CASE("SYNC start value: after a match the number is not compared again [X14]") {
  SyncNode node(with(2, 3, 10));
  node.start();
  node.rx("080#03");
  node.silent();
  node.rx("080#09");
  node.tx("181#11");
  node.rx("080#01");
  node.silent();
  node.rx("080#01");
  node.tx("181#11");
}

TEST_CASE("SYNC start value: it is compared again after each entry into Operational [X14] [N11]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    CAPTURE(std::string(command));
    SyncNode node(with(3, 4, 10));
    node.start();
    CHECK(sent_at(node, 10) == List{6, 9});
    node.rx(command);
    node.rx("000#0101");
    CHECK(sent_at(node, 20, 5) == List{12, 15, 18});  // the tenth SYNC has counter value 4
    node.rx(command);
    node.rx("000#0101");
    CHECK(sent_at(node, 10) == List{6, 9});
  }
}

TEST_CASE("SYNC start value: leaving Operational before a match has no effect [X14]") {
  SyncNode node(with(1, 4, 10));
  node.start();
  CHECK(sent_at(node, 2).empty());
  node.rx("000#8001");
  node.rx("000#0101");
  CHECK(sent_at(node, 6) == List{4, 5, 6});
}

TEST_CASE("SYNC start value: it is compared again after switching the PDO on and after a change of type [X14]") {
  SyncNode node(with(3, 4, 10));
  node.start();
  CHECK(sent_at(node, 10) == List{6, 9});
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1800, 6, 1, 2) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(sent_at(node, 10, 9) == List{6, 9});  // the fourth SYNC has counter value 2
  CHECK(node.set(0x1800, 2, 1, 1) == 0);
  CHECK(sent_at(node, 4) == List{2, 3, 4});
}

TEST_CASE("SYNC start value: without a counter in 1019h it is ignored [Y7]") {
  for (unsigned type : {1U, 3U}) {
    SyncNode node(with(static_cast<std::uint8_t>(type), 200, 0));
    node.start();
    CHECK(sent_at(node, 9) == every(type, type, 9));
  }
}

TEST_CASE("SYNC start value: with a counter in 1019h a SYNC without one sends only PDOs without start value [Y7]") {
  if (fixture_tpdos < 2) {
    return;
  }
  SyncTable table = with(1, 1, 10);
  table.tpdo[1].on(0x40000281, 1, {0x22010108});
  SyncNode node(table);
  node.start();
  node.rx("080#01");
  node.tx({"181#11", "281#11"});
  node.rx("080#");
  std::vector<std::string> sent = node.frames();
  CHECK(std::count(sent.begin(), sent.end(), "281#11") == 1);
  CHECK(std::count(sent.begin(), sent.end(), "181#11") == 0);
  node.rx("080#03");
  sent = node.frames();
  CHECK(std::count(sent.begin(), sent.end(), "281#11") == 1);
  CHECK(std::count(sent.begin(), sent.end(), "181#11") == 1);
}

TEST_CASE("SYNC start value: type 0 needs a match and then events [X14] [X1]") {
  SyncNode node(with(0, 5, 10));
  node.start();
  CHECK(sent_at(node, 10) == List{5});
  node.trigger(0);
  CHECK(sent_at(node, 10) == List{1});
}

TEST_CASE("SYNC start value: one above the overflow value never matches") {
  SyncNode node(with(1, 11, 10));
  node.start();
  CHECK(sent_at(node, 50).empty());
}

// Window --------------------------------------------------------------------------------------------------------------

TEST_CASE("synchronous window: TPDOs that could not be sent within it are withdrawn [X4] [301:7.5.2.7]") {
  SyncTable table = with(1);
  table.window = 10000;
  SyncNode node(table);
  node.start();
  node.can.refuse_all();
  node.rx("080#");
  node.after(9ms);
  CHECK(node->TxQueue.Num == 1);
  node.after(2ms);
  CHECK(node->TxQueue.Num == 0);
  node.can.accept_all();
  node.after(100ms);
  node.silent();
  CHECK(node.counters().Dropped == 1);
  node.rx("080#");
  node.tx("181#11");
}

TEST_CASE("synchronous window: its end does not withdraw event-driven TPDOs and other frames [X4]") {
  if (fixture_tpdos < 2) {
    return;
  }
  SyncTable table = with(1);
  table.window = 10000;
  table.tpdo[1].on(0x40000281, 255, {0x22010208});
  SyncNode node(table);
  node.start();
  node.can.refuse_all();
  node.rx("080#");
  node.trigger(1);
  node.rx("601#4000100000000000");
  node.after(20ms);
  node.can.accept_all();
  node.loop();
  node.tx({"281#21", "581#4300100091010F00"});
}

TEST_CASE("synchronous window: without one a TPDO is queued until the controller is free, with the newest values") {
  SyncNode node(with(1));
  node.start();
  node.can.refuse_all();
  node.rx("080#");
  node.after(1000ms);
  node.u8[0] = 0x12;
  node.rx("080#");
  node.can.accept_all();
  node.loop();
  node.tx("181#12");
}

}  // namespace

#endif
