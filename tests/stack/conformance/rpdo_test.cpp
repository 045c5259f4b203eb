// SPDX-License-Identifier: Apache-2.0
// Event-driven RPDOs, which are applied when they are received: types 254 and 255. [301:7.2.2.5.1, 7.5.2.35]
#include "support/sync_fixture.hpp"

#if CO_RPDO_N > 0

namespace {

using namespace test;

TEST_CASE("RPDO: types 254 and 255 are written at once [X2]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{254, 255}) {
    CAPTURE(unsigned{type});
    PdoTable table;
    table.rpdo[0].on(0x201, type, {0x22010108, 0x22020110, 0x22040120});
    PdoNode node(table);
    node.start();
    node.rx("201#AA0BB0C1C2C3C4");
    CHECK(node.u8[0] == 0xAA);
    CHECK(node.u16[0] == 0xB00B);
    CHECK(node.u32[0] == 0xC4C3C2C1);
    CHECK(node.u8[1] == 0x21);
    node.silent();
  }
}

TEST_CASE("RPDO: each frame is written, also with unchanged data") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  node.rx("201#42");
  CHECK(node.u8[0] == 0x42);
  node.u8[0] = 0x07;
  node.rx("201#42");
  CHECK(node.u8[0] == 0x42);
}

TEST_CASE("RPDO: a frame is written only to the objects that its PDO maps") {
  PdoTable table;
  std::uint8_t sub = 1;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, 255, {0x22010008U | std::uint32_t{sub++} << 8});
  }
  PdoNode node(table);
  node.start();
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    CO_IF_FRM frm{0x201 + n * 0x100, {static_cast<std::uint8_t>(0xC0 + n)}, 1};
    node.rx(frm);
    for (unsigned other = 0; other < fixture_rpdos; ++other) {
      CHECK(node.u8[other] == (other <= n ? 0xC0 + other : 16 * (other + 1) + 1));
    }
  }
  CHECK(node.counters().Malformed == 0);
  CHECK(node.counters().Unclaimed == 0);
}

TEST_CASE("RPDO: its slot depends neither on number nor on type of the RPDO: the last one works alone [D7]") {
  for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 255}) {
    for (unsigned n = 0; n < fixture_rpdos; ++n) {
      if (USE_SYNC == 0 && type == 1) {
        continue;
      }
      CAPTURE(n);
      SyncTable table;
      table.rpdo[n].on(0x201, type, {0x22010108});
      SyncNode node(table);
      node.start();
      node.rx("080#");
      CHECK(node.u8[0] == 0x11);
      node.rx("201#99");
      node.rx("080#");
      CHECK(node.u8[0] == 0x99);
    }
  }
}

TEST_CASE("RPDO: two RPDOs with one CAN-ID both write their objects") {
  if (fixture_rpdos < 2) {
    return;
  }
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.rpdo[1].on(0x201, 255, {0x22020110});
  PdoNode node(table);
  node.start();
  node.rx("201#3456");
  CHECK(node.u8[0] == 0x34);
  CHECK(node.u16[0] == 0x5634);
  CHECK(node.frames() == reports({emcy(0x8220, 1)}));
}

TEST_CASE("RPDO: an RPDO that does not exist receives no frame [301:7.5.2.35]") {
  PdoTable table;
  table.rpdo[0].on(0x80000201, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  node.rx("201#42");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("RPDO: remote frames and 29-bit frames of its CAN-ID are ignored [Q1]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  node.rx("201#R");
  node.rx("00000201#42");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.counters().Malformed == 1);
  CHECK(node.counters().Unclaimed == 1);
  node.silent();
}

TEST_CASE("RPDO: dummies occupy their bytes in the frame and write nothing [M8] [D44]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x00050008, 0x22010108, 0x00060010, 0x22010208, 0x00020008, 0x22020110});
  PdoNode node(table);
  node.start();
  node.rx("201#FF42FFFF43FF4455");
  CHECK(node.u8[0] == 0x42);
  CHECK(node.u8[1] == 0x43);
  CHECK(node.u16[0] == 0x5544);
  CHECK(node.u8[2] == 0x31);
}

TEST_CASE("RPDO: an RPDO of dummies only is received and its length is checked") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x00070020, 0x00040020});
  PdoNode node(table);
  node.start();
  node.rx("201#FFFFFFFFFFFFFFFF");
  node.silent();
  bool was = false;
  node.call([&] { was = CORPdoWasReceived(&node.node, 0); });
  CHECK(was);
  node.rx("201#FFFFFFFFFFFFFF");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
}

TEST_CASE("RPDO: a value that its type refuses is not written; the rest of the frame is") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010208});
  const void* closed = nullptr;
  PdoNode node(table, [&](Setup& setup) {
    setup.writable([&](const void* address, std::uint32_t) { return address != closed; });
  });
  closed = &node.u8[0];
  REQUIRE(node.remap_rpdo(0, {0x22010108, 0x22010208}, 0x201) == 0);
  node.start();
  node.rx("201#4243");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0x43);
  CHECK(node.error() == CO_ERR_OBJ_ACC);
}

TEST_CASE("RPDO: an object with flag D is written in the dictionary") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22FF0010});
  PdoNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x22FF, 0, CO_OBJ_D___RW | CO_OBJ____PRW), CO_TUNSIGNED16, 0x1234});
  });
  node.may_change(0x22FF, 0);
  node.start();
  node.rx("201#7856");
  CHECK(node.get(0x22FF, 0) == 0x5678);
}

TEST_CASE("RPDO: an object with flag N is written relative to the node-ID, as by SDO") {
  std::uint32_t stored = 0;
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22FF0020});
  PdoNode node(table, [&](Setup& setup) {
    setup.node_id(1).with({CO_KEY(0x22FF, 0, CO_OBJ__N__RW | CO_OBJ____PRW), CO_TUNSIGNED32, CO_DATA(&stored)});
  });
  node.may_change(0x22FF, 0);
  node.start();
  node.rx("201#81010000");
  CHECK(stored == 0x180);
  CHECK(node.get(0x22FF, 0) == 0x181);
}

TEST_CASE("RPDO: a 29-bit CAN-ID works [P1]") {
  PdoTable table;
  table.rpdo[0].on(0x20000000U | 0x12345678U, 255, {0x22010108});
  PdoNode node(table);
  node.start();
  node.rx("12345678#42");
  CHECK(node.u8[0] == 0x42);
  node.rx("678#43");
  CHECK(node.u8[0] == 0x42);
}

}  // namespace

#endif
