// SPDX-License-Identifier: Apache-2.0
// Synchronous RPDOs, which are applied at the SYNC: types 0 to 240. [301:7.2.2.3, 7.5.2.35]
#include "support/sync_fixture.hpp"

#if CO_RPDO_N > 0 && USE_SYNC

namespace {

using namespace test;

SyncTable with_type(std::uint8_t type) {
  SyncTable table;
  table.rpdo[0].on(0x201, type, {0x22010108});
  return table;
}

TEST_CASE("synchronous RPDO: every type 0 to 240 is written at the next SYNC [X2]") {
  for (unsigned type = 0; type <= 240; type += stride(16)) {
    CAPTURE(type);
    SyncNode node(with_type(static_cast<std::uint8_t>(type)));
    node.start();
    node.rx("201#42");
    CHECK(node.u8[0] == 0x11);
    node.after(1000ms);
    CHECK(node.u8[0] == 0x11);
    node.rx("080#");
    CHECK(node.u8[0] == 0x42);
    node.silent();
  }
}

TEST_CASE("synchronous RPDO: a SYNC before any frame writes nothing [D43]") {
  SyncNode node(with_type(1));
  node.start();
  for (int i = 0; i < 3; ++i) node.rx("080#");
  CHECK(node.u8[0] == 0x11);
}

TEST_CASE("synchronous RPDO: a frame is written once; later values of the application stay [X2] [D43]") {
  SyncNode node(with_type(1));
  node.start();
  node.rx("201#42");
  node.rx("080#");
  CHECK(node.u8[0] == 0x42);
  node.u8[0] = 0x99;
  for (int i = 0; i < 3; ++i) node.rx("080#");
  CHECK(node.u8[0] == 0x99);
}

TEST_CASE("synchronous RPDO: the last of several frames before the SYNC is written [X2]") {
  SyncNode node(with_type(1));
  node.start();
  for (const char* text : {"201#01", "201#02", "201#03"}) node.rx(text);
  unsigned updates = 0;
  callbacks().pdo_update = [&](CO_RPDO*) { ++updates; };
  node.rx("080#");
  CHECK(node.u8[0] == 3);
  CHECK(updates == 1);
}

TEST_CASE("synchronous RPDO: all frames of one SYNC are written in the order of their numbers") {
  SyncTable table;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 1, {0x22010108, 0x22020010U | (n + 1) << 8});
  }
  SyncNode node(table);
  node.start();
  for (unsigned round = 0; round < 3; ++round) {
    for (unsigned n = fixture_rpdos; n-- > 0;) {
      const auto value = static_cast<std::uint8_t>(0x10 * round + n);
      node.rx(CO_IF_FRM{0x201 + n * 0x100, {value, value, 0x77}, 3});
    }
    std::vector<CO_RPDO*> order;
    callbacks().pdo_update = [&](CO_RPDO* pdo) { order.push_back(pdo); };
    node.rx("080#");
    CHECK(node.u8[0] == 0x10 * round + fixture_rpdos - 1);  // RPDO 0 was received last
    REQUIRE(order.size() == fixture_rpdos);
    for (unsigned n = 0; n < fixture_rpdos; ++n) {
      CHECK(node.u16[n] == 0x7700 + 0x10 * round + n);
      CHECK(order[n] == &node->RPdo[n]);
    }
  }
}

TEST_CASE("synchronous RPDO: a callback that leaves Operational does not suppress those of the other RPDOs") {
  if (fixture_rpdos < 2) {
    return;
  }
  SyncTable table;
  for (unsigned n = 0; n < 2; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 1, {0x22010108, 0x22020010U | (n + 1) << 8});
  }
  SyncNode node(table);
  node.start();
  node.rx("201#112233");
  node.rx("301#445566");
  std::vector<CO_RPDO*> order;
  callbacks().pdo_update = [&](CO_RPDO* pdo) {
    order.push_back(pdo);
    CONmtSetMode(&node->Nmt, CO_PREOP);
  };
  node.rx("080#");
  CHECK(order == std::vector<CO_RPDO*>{&node->RPdo[0], &node->RPdo[1]});
  CHECK(node.u16[1] == 0x6655);
}

TEST_CASE("synchronous RPDO: event-driven RPDOs in between are written at once") {
  if (fixture_rpdos < 2) {
    return;
  }
  SyncTable table = with_type(1);
  table.rpdo[1].on(0x301, 255, {0x22010208});
  SyncNode node(table);
  node.start();
  node.rx("201#42");
  node.rx("301#43");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0x43);
  node.rx("080#");
  CHECK(node.u8[0] == 0x42);
}

TEST_CASE("synchronous RPDO: leaving Operational discards received frames [X9] [N11]") {
  for (const char* command : {"000#8001", "000#0201"}) {
    CAPTURE(std::string(command));
    SyncNode node(with_type(1));
    node.start();
    node.rx("201#42");
    node.rx(command);
    node.rx("080#");
    CHECK(node.u8[0] == 0x11);
    node.start();
    node.rx("080#");
    CHECK(node.u8[0] == 0x11);
    node.rx("201#43");
    node.rx("080#");
    CHECK(node.u8[0] == 0x43);
  }
}

TEST_CASE("synchronous RPDO: switching the PDO off discards its frame and frees its position in the list") {
  SyncTable table = with_type(1);
  const unsigned last = fixture_rpdos - 1;
  table.rpdo[last].on(0x501, 1, {0x22010808});
  SyncNode node(table);
  node.start();
  node.rx("201#42");
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  node.rx("501#58");
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
  node.rx("080#");
  CHECK(node.u8[0] == (last == 0 ? 0x58 : 0x11));
  CHECK(node.u8[7] == 0x58);
  node.rx("201#43");
  node.rx("080#");
  CHECK(node.u8[0] == 0x43);
}

TEST_CASE("synchronous RPDO: one that is switched off and on with a pending frame loses no frames of later ones") {
  if (fixture_rpdos < 2) {
    return;
  }
  SyncTable table = with_type(1);
  table.rpdo[1].on(0x301, 1, {0x22010208});
  SyncNode node(table);
  node.start();
  node.rx("201#41");
  node.rx("301#42");
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
  node.rx("201#43");
  node.rx("080#");
  CHECK(node.u8[0] == 0x43);
  CHECK(node.u8[1] == 0x42);
}

TEST_CASE("synchronous RPDO: a pending frame is not written to a new mapping") {
  SyncNode node(with_type(1));
  node.start();
  node.rx("201#42");
  CHECK(node.remap_rpdo(0, {0x22010208}, 0x201) == 0);
  node.rx("080#");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0x21);
}

TEST_CASE("synchronous RPDO: frames after the window are discarded until the next SYNC [X4] [301:7.5.2.7]") {
  SyncTable table = with_type(1);
  table.window = 20000;
  SyncNode node(table);
  node.start();
  node.rx("201#01");
  node.rx("080#");
  CHECK(node.u8[0] == 1);
  node.after(19ms);
  node.rx("201#02");  // within the window
  node.after(2ms);
  node.rx("201#03");  // late
  node.rx("080#");
  CHECK(node.u8[0] == 2);
  node.after(30ms);
  node.rx("201#04");
  node.rx("080#");
  CHECK(node.u8[0] == 2);
  node.rx("201#05");
  node.rx("080#");
  CHECK(node.u8[0] == 5);
  node.silent();
}

TEST_CASE("synchronous RPDO: the window does not apply to event-driven RPDOs [X4]") {
  SyncTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.window = 20000;
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.after(30ms);
  node.rx("201#42");
  CHECK(node.u8[0] == 0x42);
}

TEST_CASE("synchronous RPDO: without a window, and after writing 0 to it, frames are accepted at any time [X4]") {
  SyncTable table = with_type(1);
  table.window = 20000;
  SyncNode node(table);
  node.start();
  CHECK(node.set(0x1007, 0, 4, 0) == 0);
  node.rx("080#");
  node.after(1000ms);
  node.rx("201#42");
  node.rx("080#");
  CHECK(node.u8[0] == 0x42);
}

TEST_CASE("synchronous RPDO: an elapsed window is open again after writing 0 to 1007h and after Stopped [X4]") {
  for (const bool stop : {false, true}) {
    CAPTURE(stop);
    SyncTable table = with_type(1);
    table.window = 20000;
    SyncNode node(table);
    node.start();
    node.rx("080#");
    node.after(30ms);
    if (stop) {
      node.rx("000#0201");
      node.rx("000#0101");
    } else {
      CHECK(node.set(0x1007, 0, 4, 0) == 0);
    }
    node.rx("201#42");
    node.rx("080#");
    CHECK(node.u8[0] == 0x42);
  }
}

}  // namespace

#endif
