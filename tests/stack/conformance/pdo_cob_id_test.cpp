// SPDX-License-Identifier: Apache-2.0
// 1400h:1 and 1800h:1, the COB-ID of a PDO. [301:7.5.2.35, 7.5.2.37]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

/// Returns a table with RPDO 0 on 201h for 2201h:1, and TPDO 0 on 181h for 2202h:1; both are valid.
PdoTable both_on() {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 254, {0x22020110});
  return table;
}

/// Returns the table of both_on() with bit 31 set in both COB-IDs.
PdoTable both_off() {
  PdoTable table = both_on();
  table.rpdo[0].cob_id |= 0x80000000;
  table.tpdo[0].cob_id |= 0x80000000;
  return table;
}

constexpr std::uint32_t abort_range = 0x06090030;

bool is_accepted(const PdoNode& node, std::uint32_t id) {
  const std::vector<std::uint32_t>& filter = node.can.filter;
  return std::find(filter.begin(), filter.end(), id) != filter.end();
}

TEST_CASE("PDO COB-ID: 1400h:1 and 1800h:1 of every PDO are read [P1] [PDO 01] [PDO 02]") {
  PdoNode node;
  node.ask("601#4000140100000000", "581#4300140101020080");
  node.ask("601#4000180100000000", "581#43001801810100C0");
  for (unsigned n = 0; n < fixture_rpdos; ++n) {
    CHECK(node.get(static_cast<std::uint16_t>(0x1400 + n), 1) == 0x80000201 + n * 0x100);
  }
  for (unsigned n = 0; n < fixture_tpdos; ++n) {
    CHECK(node.get(static_cast<std::uint16_t>(0x1800 + n), 1) == 0xC0000181 + n * 0x100);
  }
}

TEST_CASE("PDO COB-ID: its length is 4 bytes [D5]") {
  PdoNode node;
  CHECK(node.set(0x1400, 1, 2, 0x0201) == 0x06070013);
  CHECK(node.set(0x1800, 1, 1, 0x81) == 0x06070013);
  CHECK(node.download(0x1400, 1, Bytes(5)) == 0x06070012);
  CHECK(node.rpdo[0].cob_id == 0x80000201);
}

TEST_CASE("PDO COB-ID: a PDO that is switched on in Pre-operational works in Operational [P1]") {
  PdoNode node(both_off());
  node.ask("601#2300140101020000", "581#6000140100000000");
  node.ask("601#2300180181010040", "581#6000180100000000");
  node.rx("201#2A");
  node.silent();
  CHECK(node.u8[0] == 0x11);
  node.start();
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("181#1112");
}

TEST_CASE("PDO COB-ID: switching a PDO on or off in Operational takes effect at once [P1]") {
  PdoNode node(both_off());
  node.start();
  CHECK_FALSE(is_accepted(node, 0x201));
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x11);
  for (int times = 0; times < 3; ++times) {
    node.ask("601#2300140101020000", "581#6000140100000000");
    node.rx("201#2B");
    CHECK(node.u8[0] == 0x2B);
    CHECK(is_accepted(node, 0x201));
    node.ask("601#2300140101020080", "581#6000140100000000");
    node.rx("201#2C");
    CHECK(node.u8[0] == 0x2B);
    CHECK_FALSE(is_accepted(node, 0x201));

    node.ask("601#2300180181010040", "581#6000180100000000");
    node.trigger(0);
    node.tx("181#1112");
    node.ask("601#23001801810100C0", "581#6000180100000000");
    node.trigger(0);
    node.silent();
  }
}

TEST_CASE("PDO COB-ID: a PDO uses only the CAN-ID with which it was enabled [P1]") {
  PdoNode node(both_off());
  node.start();
  CHECK(node.set(0x1400, 1, 4, 0x80000333) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x333) == 0);
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x11);
  node.rx("333#2B");
  CHECK(node.u8[0] == 0x2B);
  CHECK(node.set(0x1800, 1, 4, 0x40000480) == 0);
  node.trigger(0);
  node.tx("480#1112");
}

TEST_CASE("PDO COB-ID: bits 0 to 29 cannot be changed while the RPDO exists: 0609 0030h [P2]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#2300140102020000", "581#8000140130000906");
  for (unsigned bit = 0; bit < 30; ++bit) {
    CAPTURE(bit);
    CHECK(node.set(0x1400, 1, 4, 0x201U ^ 1U << bit) == abort_range);
  }
  CHECK(node.get(0x1400, 1) == 0x201);
  node.rx("202#2A");
  CHECK(node.u8[0] == 0x11);
  node.rx("201#2B");
  CHECK(node.u8[0] == 0x2B);
}

TEST_CASE("PDO COB-ID: bits 0 to 29 cannot be changed while the TPDO exists: 0609 0030h [P2]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#2300180182010040", "581#8000180130000906");
  for (unsigned bit = 0; bit < 30; ++bit) {
    CAPTURE(bit);
    CHECK(node.set(0x1800, 1, 4, 0x40000181U ^ 1U << bit) == abort_range);
  }
  CHECK(node.get(0x1800, 1) == 0x40000181);
  node.trigger(0);
  node.tx("181#1112");
}

TEST_CASE("PDO COB-ID: the present value may be written while the PDO exists [P3]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#2300140101020000", "581#6000140100000000");
  node.ask("601#2300180181010040", "581#6000180100000000");
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("181#1112");
}

TEST_CASE("PDO COB-ID: bit 31 may be set together with another CAN-ID [P3]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#2300140134020080", "581#6000140100000000");
  node.ask("601#4000140100000000", "581#4300140134020080");
  node.ask("601#23001801FFFFFFFF", "581#6000180100000000");
  node.ask("601#4000180100000000", "581#43001801FFFFFFFF");
  node.rx("201#2A");
  node.rx("234#2A");
  CHECK(node.u8[0] == 0x11);
  node.trigger(0);
  node.silent();
}

TEST_CASE("PDO COB-ID: bits 11 to 28 without bit 29 are refused with 0609 0030h if the PDO is switched on [P4]") {
  PdoNode node(both_off());
  node.ask("601#2300140101120000", "581#8000140130000906");
  for (unsigned bit = 11; bit < 29; ++bit) {
    CAPTURE(bit);
    CHECK(node.set(0x1400, 1, 4, 0x201U | 1U << bit) == abort_range);
    CHECK(node.set(0x1800, 1, 4, 0x40000181U | 1U << bit) == abort_range);
  }
  CHECK(node.get(0x1400, 1) == 0x80000201);
  CHECK(node.get(0x1800, 1) == 0xC0000181);
}

TEST_CASE("PDO COB-ID: an RPDO with bit 29 receives 29-bit frames only [P1] [P4]") {
  PdoNode node(both_off());
  node.start();
  node.ask("601#2300140145230120", "581#6000140100000000");
  for (const char* foreign : {"345#2A", "00010345#2A", "10012345#2A", "201#2A"}) {
    node.rx(foreign);
  }
  CHECK(node.u8[0] == 0x11);
  node.rx("00012345#2B");
  CHECK(node.u8[0] == 0x2B);
}

TEST_CASE("PDO COB-ID: a 29-bit CAN-ID below 800h does not match the 11-bit one of the same value [P1] [P4]") {
  PdoTable table = both_off();
  table.rpdo[0].cob_id = 0x20000201;
  PdoNode node(table);
  node.start();
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x11);
  node.rx("00000201#2B");
  CHECK(node.u8[0] == 0x2B);
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
  node.rx("00000201#2C");
  CHECK(node.u8[0] == 0x2B);
  node.rx("201#2D");
  CHECK(node.u8[0] == 0x2D);
}

TEST_CASE("PDO COB-ID: a TPDO with bit 29 sends 29-bit frames [P1] [P4]") {
  PdoNode node(both_off());
  node.start();
  node.ask("601#23001801FFFFFF7F", "581#6000180100000000");
  node.trigger(0);
  node.tx("1FFFFFFF#1112");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.ask("601#2300180181010060", "581#6000180100000000");
  node.trigger(0);
  node.tx("00000181#1112");
}

TEST_CASE("PDO COB-ID: bit 30 of an RPDO has no effect and is read back [P4]") {
  PdoNode node(both_off());
  node.start();
  node.ask("601#2300140101020040", "581#6000140100000000");
  node.ask("601#4000140100000000", "581#4300140101020040");
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  node.ask("601#2300140101020000", "581#6000140100000000");
  node.rx("201#2B");
  CHECK(node.u8[0] == 0x2B);
  node.ask("601#2300140102020040", "581#8000140130000906");
}

#if USE_PDO_RTR

TEST_CASE("PDO COB-ID: bit 30 of a TPDO may be changed while it exists and takes effect at once [P2]") {
  PdoNode node(both_on());
  node.start();
  for (int times = 0; times < 3; ++times) {
    node.rx("181#R");
    node.silent();
    node.ask("601#2300180181010000", "581#6000180100000000");
    node.ask("601#4000180100000000", "581#4300180181010000");
    CHECK(is_accepted(node, 0x181));
    node.rx("181#R");
    node.tx("181#1112");
    node.ask("601#2300180181010040", "581#6000180100000000");
    CHECK_FALSE(is_accepted(node, 0x181));
  }
}

TEST_CASE("PDO COB-ID: a TPDO answers remote requests without bit 30 and ignores them with it [P4] [X11] [X13]") {
  PdoNode node(both_off());
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0x181) == 0);
  node.rx("181#R");
  node.tx("181#1112");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  node.rx("181#R");
  node.silent();
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.rx("181#R");
  node.silent();
}

#else

TEST_CASE("PDO COB-ID: a node without remote requests refuses a TPDO without bit 30: 0609 0030h [P4]") {
  PdoNode node(both_off());
  CHECK(node.set(0x1800, 1, 4, 0x181) == abort_range);
  CHECK(node.get(0x1800, 1) == 0xC0000181);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x181) == abort_range);
}

#endif

TEST_CASE("PDO COB-ID: a PDO without mapping cannot be switched on: 0609 0030h [P6]") {
  PdoNode node;
  node.start();
  node.ask("601#2300140101020000", "581#8000140130000906");
  node.ask("601#2300180181010040", "581#8000180130000906");
  CHECK(node.get(0x1400, 1) == 0x80000201);
  CHECK(node.get(0x1800, 1) == 0xC0000181);
  node.rx("201#2A");
  node.trigger(0);
  node.silent();
}

TEST_CASE("PDO COB-ID: a PDO whose mapping was removed cannot be switched on again: 0609 0030h [P6]") {
  PdoNode node(both_on());
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1600, 0, 1, 0) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == abort_range);
  CHECK(node.set(0x1600, 0, 1, 1) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
}

TEST_CASE("PDO COB-ID: a TPDO that does not exist is not sent under any CAN-ID [D36]") {
  PdoNode node(both_off());
  node.start();
  node.trigger(0);
  CHECK(node.error() == CO_ERR_TPDO_COM_OBJ);
  CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);
  node.silent();
}

TEST_CASE("PDO COB-ID: PDOs without entries in the table do not exist, and nothing is sent at 000h [D36]") {
  PdoNode node({}, [](Setup& setup) {
    for (std::uint8_t sub = 0; sub <= CO_PDO_MAP_N; ++sub) {
      setup.without(0x1400, sub).without(0x1800, sub).without(0x1600, sub).without(0x1A00, sub);
    }
  });
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  node.trigger(0);
  CHECK(node.error() == CO_ERR_TPDO_COM_OBJ);
  node.rx("000#2A");
  node.rx("201#2A");
  node.rx("00000000#2A");
  node.silent();
}

TEST_CASE("PDO COB-ID: the value may be stored in the entry (flag D) [P1]") {
  PdoNode node(both_on(), [](Setup& setup) {
    setup.with({CO_KEY(0x1400, 1, CO_OBJ_DN__RW), CO_TPDO_ID, 0x80000300});
    setup.with({CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, CO_COBID_TPDO_DEFAULT(0)});
  });
  node.start();
  CHECK(node.get(0x1400, 1) == 0x80000301);
  CHECK(node.get(0x1800, 1) == 0x40000181);
  node.trigger(0);
  node.tx("181#1112");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0x06010002);
  CHECK(node.set(0x1400, 1, 4, 0x301) == 0);
  node.rx("301#2A");
  CHECK(node.u8[0] == 0x2A);
}

TEST_CASE("PDO COB-ID: after a reset communication the configuration is that of the dictionary") {
  PdoNode node(both_on());
  node.start();
  node.rpdo[0].cob_id = 0x234;
  node.tpdo[0].cob_id = 0x40000567;
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  node.rx("000#8201");
  node.tx("701#00");
  node.start();
  node.rx("201#2B");
  CHECK(node.u8[0] == 0x2A);
  node.rx("234#2C");
  CHECK(node.u8[0] == 0x2C);
  node.trigger(0);
  node.tx("567#1112");
  CHECK(is_accepted(node, 0x234));
  CHECK_FALSE(is_accepted(node, 0x201));
}

TEST_CASE("PDO COB-ID: the rules apply to writes of the application [P2] [P6]") {
  PdoNode node(both_on());
  node.may_change(0x1400, 1);
  const auto write = [&](std::uint32_t value) {
    CO_ERR err = CO_ERR_NONE;
    node.call([&] { err = CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), value); });
    return err;
  };
  CHECK(write(0x202) == CO_ERR_OBJ_RANGE);
  CHECK(write(0x80000202) == CO_ERR_NONE);
  CHECK(write(CO_RESTRICTED_IDS == 0 ? 0x101 : 0x000) == CO_ERR_OBJ_RANGE);
  CHECK(write(0x202) == CO_ERR_NONE);
  node.start();
  node.rx("202#2A");
  CHECK(node.u8[0] == 0x2A);
}

#if CO_RPDO_N >= 4

TEST_CASE("PDO COB-ID: several RPDOs with one CAN-ID all receive its frames until they are switched off") {
  PdoTable table;
  for (unsigned n = 0; n < 4; ++n) {
    table.rpdo[n].on(0x222, 255, {0x22010008U | (n + 1) << 8});
  }
  PdoNode node(table);
  node.start();
  node.rx("222#A1");
  for (unsigned n = 0; n < 4; ++n) {
    CHECK(node.u8[n] == 0xA1);
  }
  CHECK(node.set(0x1402, 1, 4, 0x80000222) == 0);
  node.rx("222#A2");
  CHECK(node.u8[0] == 0xA2);
  CHECK(node.u8[1] == 0xA2);
  CHECK(node.u8[2] == 0xA1);
  CHECK(node.u8[3] == 0xA2);
  CHECK(is_accepted(node, 0x222));
}

#endif

// 1400h:1 and 1800h:1 relative to the node-ID (flag N). [301:7.5.2.35, 7.5.2.37]

/// Returns a table with RPDO 0 on 200h + node-ID for 2201h:1, and TPDO 0 on 180h + node-ID for 2202h:1.
PdoTable relative() {
  PdoTable table;
  table.rpdo[0].on(0x200, 255, {0x22010108});
  table.tpdo[0].on(0x40000180, 254, {0x22020110});
  return table;
}

/// A node with node-ID 127, whose PDOs have COB-IDs relative to the node-ID. Its SDO server uses the CAN-IDs of node-ID
/// 1, which the fixture requires.
struct Relative : PdoNode {
  explicit Relative(PdoTable& memory)
      : PdoNode(memory, [&](Setup& setup) {
          setup.node_id(0x7F);
          setup.with({CO_KEY(0x1200, 1, CO_OBJ_D___R_), CO_TSDO_ID, 0x601});
          setup.with({CO_KEY(0x1200, 2, CO_OBJ_D___R_), CO_TSDO_ID, 0x581});
          setup.with({CO_KEY(0x1400, 1, CO_OBJ__N__RW), CO_TPDO_ID, &memory.rpdo[0].cob_id});
          setup.with({CO_KEY(0x1800, 1, CO_OBJ__N__RW), CO_TPDO_ID, &memory.tpdo[0].cob_id});
        }) {}
};

TEST_CASE("PDO COB-ID: a relative one works and is read with the node-ID added [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  node.rx("000#017F");
  CHECK(node.get(0x1400, 1) == 0x27F);
  CHECK(node.get(0x1800, 1) == 0x400001FF);
  node.rx("27F#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("1FF#1112");
}

TEST_CASE("PDO COB-ID: a CAN-ID below the node-ID does not change the flags [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  node.rx("000#017F");
  for (const std::uint32_t id : {0x80000000U, 0x80000001U, 0x8000007EU, 0xA0000000U, 0xE0000010U, 0xFFFFFFFFU}) {
    CAPTURE(id);
    CHECK(node.set(0x1400, 1, 4, id) == 0);
    CHECK(node.get(0x1400, 1) == id);
    CHECK(node.set(0x1800, 1, 4, id) == 0);
    CHECK(node.get(0x1800, 1) == id);
  }
  node.trigger(0);
  node.silent();
  CHECK(node.set(0x1400, 1, 4, 0x190) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000191) == 0);
  CHECK(node.get(0x1400, 1) == 0x190);
  node.rx("190#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("191#1112");
  node.rx("000#827F");
  node.tx("77F#00");
  CHECK(node.get(0x1400, 1) == 0x190);
  CHECK(node.get(0x1800, 1) == 0x40000191);
}

TEST_CASE("PDO COB-ID: a relative one cannot be changed while the PDO exists [P2] [P3] [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  CHECK(node.set(0x1400, 1, 4, 0x200) == abort_range);
  CHECK(node.set(0x1400, 1, 4, 0x27F) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000180) == abort_range);
  CHECK(node.set(0x1800, 1, 4, 0x400001FF) == 0);
  CHECK(memory.rpdo[0].cob_id == 0x200);
  CHECK(memory.tpdo[0].cob_id == 0x40000180);
}

}  // namespace
