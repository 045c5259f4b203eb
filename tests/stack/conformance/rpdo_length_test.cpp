// SPDX-License-Identifier: Apache-2.0
// RPDOs that are shorter or longer than their mapping. [301:7.2.7.1 table 26, 7.2.2.5.1]
#include "support/sync_fixture.hpp"

#if CO_RPDO_N > 0

namespace {

using namespace test;

PdoTable of_four_bytes(std::uint8_t type = 255) {
  PdoTable table;
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    table.rpdo[n].on(0x201 + n * 0x100, type, {0x22010108, 0x22010208, 0x22020110});
  }
  return table;
}

CO_IF_FRM pdo(std::uint32_t id, std::uint8_t dlc) {
  CO_IF_FRM frm{id, {}, dlc};
  std::fill(std::begin(frm.Data), std::end(frm.Data), std::uint8_t{0xEE});
  return frm;
}

TEST_CASE("RPDO length: a frame with fewer bytes than mapped writes nothing: EMCY 8210h [X5] [D44] [Emergency 04]") {
  for (std::uint8_t dlc = 0; dlc < 4; ++dlc) {
    CAPTURE(unsigned{dlc});
    PdoNode node(of_four_bytes());
    node.start();
    node.rx(pdo(0x201, dlc));
    CHECK(node.frames() == reports({emcy(0x8210, 1)}));
    CHECK(node.u8[0] == 0x11);
    CHECK(node.u8[1] == 0x21);
    CHECK(node.u16[0] == 0x1211);
    CHECK(node.counters().Malformed == 1);
    bool was = true;
    node.call([&] { was = CORPdoWasReceived(&node.node, 0); });
    CHECK_FALSE(was);
  }
}

TEST_CASE("RPDO length: a frame with more bytes than mapped writes the first ones: EMCY 8220h [X5] [D44]") {
  for (std::uint8_t dlc = 5; dlc <= 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    PdoNode node(of_four_bytes());
    node.start();
    node.rx(pdo(0x201, dlc));
    CHECK(node.frames() == reports({emcy(0x8220, 1)}));
    CHECK(node.u8[0] == 0xEE);
    CHECK(node.u8[1] == 0xEE);
    CHECK(node.u16[0] == 0xEEEE);
    CHECK(node.u8[2] == 0x31);
    CHECK(node.counters().Malformed == 0);
  }
}

TEST_CASE("RPDO length: every mapped length with every DLC has the defined effect [X5] [T12]") {
  for (std::uint8_t mapped = 1; mapped <= 8; ++mapped) {
    for (std::uint8_t dlc = 0; dlc <= 8; ++dlc) {
      CAPTURE(unsigned{mapped});
      CAPTURE(unsigned{dlc});
      PdoTable table;
      table.rpdo[0].on(
          0x201, 255, {0x22010108, 0x22010208, 0x22010308, 0x22010408, 0x22010508, 0x22010608, 0x22010708, 0x22010808});
      table.rpdo[0].number = mapped;
      PdoNode node(table);
      node.start();
      node.rx(pdo(0x201, dlc));
      const std::uint16_t code = dlc < mapped ? 0x8210 : 0x8220;
      CHECK(node.frames() == (dlc == mapped ? std::vector<std::string>{} : reports({emcy(code, 1)})));
      for (unsigned i = 0; i < 8; ++i) {
        const bool written = dlc >= mapped && i < mapped;
        CHECK(node.u8[i] == (written ? 0xEE : 16 * (i + 1) + 1));
      }
    }
  }
}

TEST_CASE("RPDO length: a DLC of 9 to 15 means eight bytes [ISO 11898-1]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22080140});
  PdoNode node(table);
  node.start();
  for (std::uint8_t dlc = 8; dlc <= 15; ++dlc) {
    node.rx(pdo(0x201, dlc));
    node.silent();
    CHECK(node.u64[0] == 0xEEEEEEEEEEEEEEEE);
  }
}

TEST_CASE("RPDO length: short frames are reported once until a correct frame resolves it: 0000h [X5] [E1]") {
  PdoNode node(of_four_bytes());
  node.start();
  node.rx("201#AABB");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  for (int i = 0; i < 5; ++i) {
    node.rx("201#AABB");
    node.silent();
  }
  node.rx("201#01020304");
  CHECK(node.frames() == reports({emcy(0, 1)}));
  CHECK(node.u8[0] == 0x01);
  node.rx("201#01020304");
  node.silent();
  node.rx("201#");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  node.rx("201#05020304");
  CHECK(node.frames() == reports({emcy(0, 1)}));
}

TEST_CASE("RPDO length: long frames are reported once until a correct frame resolves it: 0000h [X5] [E1]") {
  PdoNode node(of_four_bytes());
  node.start();
  node.rx("201#0102030405");
  CHECK(node.frames() == reports({emcy(0x8220, 1)}));
  node.rx("201#010203040506");
  node.silent();
  node.rx("201#01020304");
  CHECK(node.frames() == reports({emcy(0, 1)}));
}

TEST_CASE("RPDO length: a change from too short to too long resolves one fault and reports the other [X5] [E2]") {
  PdoNode node(of_four_bytes());
  node.start();
  node.rx("201#01");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  node.rx("201#0102030405");
  const std::vector<std::string> sent = node.frames();
  CHECK(sent == reports({emcy(0, 1), emcy(0x8220, 1)}));
  node.rx("201#01020304");
  CHECK(node.frames() == reports({emcy(0, 1)}));
}

#if USE_EMCY
TEST_CASE("RPDO length: faults of PDOs are independent; resolving the last one clears the register [E2] [E3]") {
  if (fixture_rpdos < 2) {
    return;
  }
  PdoNode node(of_four_bytes());
  node.start();
  node.rx("201#01");
  node.tx(emcy(0x8210, 1));
  node.rx("301#01");
  node.tx(emcy(0x8210, 2));
  CHECK(node.objects.error_register == 0x11);
  node.rx("201#01020304");
  node.tx("081#0000110000010000");
  CHECK(node.objects.error_register == 0x11);
  node.rx("301#01020304");
  node.tx("081#0000000000020000");
  CHECK(node.objects.error_register == 0);
}
#endif

TEST_CASE("RPDO length: a synchronous RPDO is checked when received; a short one does not replace a correct one [X5]") {
  if (USE_SYNC == 0) {
    return;
  }
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22010108, 0x22010208});
  SyncNode node(table);
  node.start();
  node.rx("201#A1A2");
  node.rx("201#B1");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  node.rx("080#");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0xA2);
  node.rx("201#C1C2C3");
  CHECK(node.frames() == reports({emcy(0, 1), emcy(0x8220, 1)}));
  node.rx("080#");
  CHECK(node.u8[0] == 0xC1);
  CHECK(node.u8[1] == 0xC2);
}

TEST_CASE("RPDO length: leaving Operational resolves reported faults [E10]") {
  for (const std::string command : {"000#8001", "000#0201"}) {
    CAPTURE(command);
    PdoNode node(of_four_bytes());
    node.start();
    node.rx("201#01");
    CHECK(node.frames() == reports({emcy(0x8210, 1)}));
    node.rx(command);
    const bool may_send = command == "000#8001";
    CHECK(node.frames() == (may_send ? reports({emcy(0, 1)}) : std::vector<std::string>{}));
    CHECK(node.objects.error_register == 0);
    node.rx("000#0101");
    node.rx("201#01");
    CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  }
}

TEST_CASE("RPDO length: switching the PDO off resolves its reported faults") {
  PdoNode node(of_four_bytes());
  node.start();
  node.rx("201#01");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.frames() == reports({emcy(0, 1)}));
  CHECK(node.objects.error_register == 0);
}

TEST_CASE("RPDO length: a reset clears reported faults without a message") {
  for (const std::string command : {"000#8101", "000#8201"}) {
    CAPTURE(command);
    PdoNode node(of_four_bytes());
    node.start();
    node.rx("201#01");
    node.frames();
    node.rx(command);
    node.tx("701#00");
    CHECK(node.objects.error_register == 0);
    node.start();
    node.rx("201#01");
    CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  }
}

TEST_CASE("RPDO length: faults are not reported in Pre-operational and Stopped [X9]") {
  PdoNode node(of_four_bytes());
  node.rx("201#01");
  node.silent();
  node.rx("000#0201");
  node.rx("201#0102030405");
  node.silent();
  CHECK(node.objects.error_register == 0);
}

}  // namespace

#endif
