// SPDX-License-Identifier: Apache-2.0
// 1600h… and 1A00h…, written by the network: the remapping procedure, and mappable objects. [301:7.5.2.36, 7.5.2.38]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

constexpr std::uint32_t abort_access = 0x06010000;
constexpr std::uint32_t abort_no_object = 0x06020000;
constexpr std::uint32_t abort_not_mappable = 0x06040041;

/// Returns a table with RPDO 0 on 201h for 2201h:1 and :2, and TPDO 0 on 181h for 2202h:1 and :2; both are valid.
PdoTable both_on() {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22010208});
  table.tpdo[0].on(0x40000181, 254, {0x22020110, 0x22020210});
  return table;
}

/// Returns the table of both_on() with bit 31 set.
PdoTable both_off() {
  PdoTable table = both_on();
  table.rpdo[0].cob_id |= 0x80000000;
  table.tpdo[0].cob_id |= 0x80000000;
  return table;
}

// Remapping procedure -------------------------------------------------------------------------------------------------

TEST_CASE("PDO mapping: an RPDO is mapped anew by the procedure [M1] [PDO 21] [PDO 22]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#4000160000000000", "581#4F00160002000000");
  node.ask("601#4000160200000000", "581#4300160208020122");
  node.ask("601#2300140101020080", "581#6000140100000000");
  node.ask("601#2F00160000000000", "581#6000160000000000");
  node.ask("601#2300160110030222", "581#6000160100000000");
  node.ask("601#2300160208040122", "581#6000160200000000");
  node.ask("601#2300160320050422", "581#6000160300000000");
  node.ask("601#2F00160003000000", "581#6000160000000000");
  node.ask("601#2300140101020000", "581#6000140100000000");
  node.ask("601#4000160300000000", "581#4300160320050422");
  node.rx("201#A1A2A3A4A5A6A7");
  CHECK(node.u16[2] == 0xA2A1);
  CHECK(node.u8[3] == 0xA3);
  CHECK(node.u32[4] == 0xA7A6A5A4);
  CHECK(node.u8[0] == 0x11);
  CHECK(node.u8[1] == 0x21);
}

TEST_CASE("PDO mapping: a TPDO is mapped anew by the procedure [M1] [PDO 21] [PDO 22]") {
  PdoNode node(both_on());
  node.start();
  node.trigger(0);
  node.tx("181#11122122");
  node.ask("601#23001801810100C0", "581#6000180100000000");
  node.ask("601#2F001A0000000000", "581#60001A0000000000");
  node.ask("601#23001A0120010422", "581#60001A0100000000");
  node.ask("601#23001A0208080122", "581#60001A0200000000");
  node.ask("601#2F001A0002000000", "581#60001A0000000000");
  node.ask("601#2300180181010040", "581#6000180100000000");
  node.trigger(0);
  node.tx("181#1112131481");
}

TEST_CASE("PDO mapping: sub 0 may be set to fewer entries and to more again [M1] [M6]") {
  PdoTable table;
  table.tpdo[0].on(0x40000181, 254, {0x22010108, 0x22010208, 0x22010308, 0x22010408});
  PdoNode node(table);
  node.start();
  const char* const frames[] = {"181#11", "181#1121", "181#112131", "181#11213141"};
  for (const unsigned number : {1U, 4U, 2U, 3U}) {
    CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
    CHECK(node.set(0x1A00, 0, 1, number) == 0);
    CHECK(node.get(0x1A00, 0) == number);
    CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
    node.trigger(0);
    node.tx(frames[number - 1]);
  }
}

TEST_CASE("PDO mapping: sub 0 may be changed without writing 0 before while the PDO does not exist [M1]") {
  PdoNode node(both_off());
  CHECK(node.set(0x1600, 0, 1, 1) == 0);
  CHECK(node.set(0x1600, 0, 1, 2) == 0);
  CHECK(node.set(0x1600, 0, 1, 2) == 0);
}

TEST_CASE("PDO mapping: no entry can be written while the PDO exists, nor its present value [M2] [PDO 24]") {
  PdoNode node(both_on());
  for (int states = 0; states < 2; ++states) {
    node.ask("601#2300160108010122", "581#8000160100000106");
    node.ask("601#2300160108030122", "581#8000160100000106");
    node.ask("601#2F00160000000000", "581#8000160000000106");
    node.ask("601#2F00160002000000", "581#8000160000000106");
    node.ask("601#23001A0110010222", "581#80001A0100000106");
    node.ask("601#2F001A0000000000", "581#80001A0000000106");
    node.ask("601#2F001A0002000000", "581#80001A0000000106");
    for (std::uint8_t sub = 3; sub <= 8; ++sub) {
      CHECK(node.set(0x1600, sub, 4, 0) == abort_access);
      CHECK(node.set(0x1A00, sub, 4, 0) == abort_access);
    }
    node.start();
  }
  CHECK(node.get(0x1600, 0) == 2);
  CHECK(node.get(0x1A00, 0) == 2);
  node.rx("201#A1A2");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0xA2);
  node.trigger(0);
  node.tx("181#11122122");
}

TEST_CASE("PDO mapping: no entry can be written while sub 0 is not 0, nor its present value [M3] [PDO 23]") {
  PdoNode node(both_off());
  node.ask("601#2300160108010122", "581#8000160100000106");
  node.ask("601#2300160108030122", "581#8000160100000106");
  node.ask("601#2300160808030122", "581#8000160800000106");
  node.ask("601#23001A0110010222", "581#80001A0100000106");
  node.ask("601#23001A0100000000", "581#80001A0100000106");
  CHECK(node.get(0x1600, 1) == 0x22010108);
}

TEST_CASE("PDO mapping: while bit 31 is 0 no entry can be written, also if a wrong table disables the PDO [M2]") {
  PdoTable table;
  table.rpdo[0].cob_id = 0x201;
  table.tpdo[0].cob_id = 0x40000181;
  PdoNode node(table);
  CHECK(node.set(0x1600, 1, 4, 0x22010108) == abort_access);
  CHECK(node.set(0x1600, 0, 1, 0) == abort_access);
  CHECK(node.set(0x1A00, 1, 4, 0x22010108) == abort_access);
  CHECK(node.set(0x1A00, 0, 1, 0) == abort_access);
  node.start();
  REQUIRE(node.remap_rpdo(0, {0x22010108}, 0x201) == 0);
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
}

TEST_CASE("PDO mapping: the state of other PDOs does not affect the procedure [M2] [M3]") {
  PdoNode node(both_on());
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1600, 0, 1, 0) == 0);
  CHECK(node.set(0x1600, 1, 4, 0x22040120) == 0);
  CHECK(node.set(0x1A00, 0, 1, 0) == abort_access);
  node.start();
  node.trigger(0);
  node.tx("181#11122122");
}

// Mappable objects --------------------------------------------------------------------------------------------------

/// A node whose RPDO 0 and TPDO 0 are ready to be mapped.
struct Ready : PdoNode {
  Ready(const std::function<void(Setup&)>& change = {}) : PdoNode({}, change) {}
  std::uint32_t rpdo_word(std::uint32_t word) { return set(0x1600, 1, 4, word); }
  std::uint32_t tpdo_word(std::uint32_t word) { return set(0x1A00, 1, 4, word); }
};

TEST_CASE("PDO mapping: an index without an object is refused with 0602 0000h [M4]") {
  Ready node;
  node.ask("601#2300160108000030", "581#8000160100000206");
  node.ask("601#23001A0108000030", "581#80001A0100000206");
  for (const std::uint32_t word : {0x30000108U, 0x220A0108U, 0xFFFFFF08U, 0x00080020U, 0x001B0040U, 0x00000008U}) {
    CAPTURE(word);
    CHECK(node.rpdo_word(word) == abort_no_object);
    CHECK(node.tpdo_word(word) == abort_no_object);
    CHECK(node.get(0x1600, 1) == 0);
  }
}

TEST_CASE("PDO mapping: a missing sub-index is refused with 0604 0041h [M4]") {
  Ready node;
  node.ask("601#2300160108090122", "581#8000160141000406");
  for (const std::uint32_t word : {0x22010908U, 0x2201FF08U, 0x22040920U, 0x20010108U, 0x20330020U}) {
    CAPTURE(word);
    CHECK(node.rpdo_word(word) == abort_not_mappable);
    CHECK(node.tpdo_word(word) == abort_not_mappable);
  }
}

TEST_CASE("PDO mapping: an object that cannot be mapped is refused with 0604 0041h [M5] [PDO 29] [PDO 32]") {
  Ready node;
  node.ask("601#2300160108014122", "581#8000160141000406");
  node.ask("601#23001A0108014122", "581#80001A0141000406");
  for (const std::uint32_t word : {0x22410108U, 0x22420110U, 0x22440120U, 0x22480140U, 0x22010008U, 0x10000020U}) {
    CAPTURE(word);
    CHECK(node.rpdo_word(word) == abort_not_mappable);
    CHECK(node.tpdo_word(word) == abort_not_mappable);
  }
}

TEST_CASE("PDO mapping: an RPDO needs objects with write access, a TPDO with read access [M5] [PDO 27] [PDO 28]") {
  struct Width {
    std::uint32_t read;
    std::uint32_t write;
  };
  for (const Width& one : {Width{0x22210108, 0x22310108}, Width{0x22220110, 0x22320110}, Width{0x22240120, 0x22340120},
                           Width{0x22280140, 0x22380140}}) {
    CAPTURE(one.read);
    Ready node;
    CHECK(node.rpdo_word(one.read) == abort_not_mappable);
    CHECK(node.rpdo_word(one.write) == 0);
    CHECK(node.tpdo_word(one.write) == abort_not_mappable);  // [PDO 31]
    CHECK(node.tpdo_word(one.read) == 0);                    // [PDO 30]
  }
}

TEST_CASE(
    "PDO mapping: write-only objects are written by an RPDO, read-only ones are sent by a TPDO [PDO 27] [PDO 30]") {
  PdoNode node;
  node.start();
  REQUIRE(node.remap_rpdo(0, {0x22310108, 0x22320110, 0x22340120}, 0x201) == 0);
  node.rx("201#A1A2A3A4A5A6A7");
  CHECK(node.w8 == 0xA1);
  CHECK(node.w16 == 0xA3A2);
  CHECK(node.w32 == 0xA7A6A5A4);
  REQUIRE(node.remap_rpdo(0, {0x22380140}, 0x201) == 0);
  node.rx("201#B1B2B3B4B5B6B7B8");
  CHECK(node.w64 == 0xB8B7B6B5B4B3B2B1);
  REQUIRE(node.remap_tpdo(0, {0x22210108, 0x22220110, 0x22240120}, 0x40000181) == 0);
  node.trigger(0);
  node.tx("181#11111211121314");
  REQUIRE(node.remap_tpdo(0, {0x22280140}, 0x40000181) == 0);
  node.trigger(0);
  node.tx("181#1112131415161718");
}

TEST_CASE("PDO mapping: a length that differs from the object is refused with 0604 0041h [M5] [D37]") {
  struct Object {
    std::uint32_t word;
    unsigned bits;
  };
  Ready node;
  for (unsigned width = 1; width <= 8; ++width) {
    const Object object{0x22000100U + (width << 16), width * 8};
    for (unsigned bits = 0; bits <= 255; ++bits) {
      CAPTURE(width);
      CAPTURE(bits);
      const std::uint32_t expected = bits == object.bits ? 0 : abort_not_mappable;
      CHECK(node.rpdo_word(object.word | bits) == expected);
      CHECK(node.tpdo_word(object.word | bits) == expected);
    }
  }
}

TEST_CASE("PDO mapping: an entry may be cleared with 0000 0000h while sub 0 is 0 [M6]") {
  Ready node;
  CHECK(node.rpdo_word(0x22010108) == 0);
  node.ask("601#2300160100000000", "581#6000160100000000");
  node.ask("601#4000160100000000", "581#4300160100000000");
  CHECK(node.tpdo_word(0x22010108) == 0);
  node.ask("601#23001A0100000000", "581#60001A0100000000");
}

TEST_CASE("PDO mapping: a refused entry keeps its value [M5]") {
  Ready node;
  CHECK(node.rpdo_word(0x22010108) == 0);
  for (const std::uint32_t word : {0x30000108U, 0x22410108U, 0x22010110U, 0x00020010U}) {
    CHECK(node.rpdo_word(word) != 0);
    CHECK(node.get(0x1600, 1) == 0x22010108);
  }
}

// Precedence of abort codes -------------------------------------------------------------------------------------------

TEST_CASE("PDO mapping: checks are ordered: existing PDO, sub 0, missing index [M2] [M3] [M4]") {
  {
    PdoNode node(both_on());
    for (const std::uint32_t word : {0x30000108U, 0x22010908U, 0x22410108U, 0x22010100U}) {
      CHECK(node.set(0x1600, 1, 4, word) == abort_access);
      CHECK(node.set(0x1A00, 1, 4, word) == abort_access);
    }
    for (const unsigned number : {9U, 65U, 0xFEU, 0xFFU}) {
      CHECK(node.set(0x1600, 0, 1, number) == abort_access);
      CHECK(node.set(0x1A00, 0, 1, number) == abort_access);
    }
    CHECK(node.get(0x1600, 0) == 2);
  }
  {
    PdoNode node(both_off());
    for (const std::uint32_t word : {0x30000108U, 0x22010908U, 0x22410108U, 0x22010100U, 0U}) {
      CHECK(node.set(0x1600, 1, 4, word) == abort_access);
      CHECK(node.set(0x1A00, 1, 4, word) == abort_access);
    }
  }
  {
    Ready node;
    for (const std::uint32_t word : {0x30000100U, 0x300001FFU, 0x30000101U, 0xFFFF0007U}) {
      CHECK(node.rpdo_word(word) == abort_no_object);
      CHECK(node.tpdo_word(word) == abort_no_object);
    }
    for (const std::uint32_t word : {0x22010900U, 0x220109FFU, 0x22410100U}) {
      CHECK(node.rpdo_word(word) == abort_not_mappable);
      CHECK(node.tpdo_word(word) == abort_not_mappable);
    }
  }
}

TEST_CASE("PDO mapping: the length of the download is checked first [M2] [D5]") {
  PdoNode node(both_on());
  CHECK(node.set(0x1600, 1, 2, 0x0108) == 0x06070013);
  CHECK(node.set(0x1600, 0, 2, 0) == 0x06070012);
}

TEST_CASE("PDO mapping: the rules apply to writes of the application [M2] [M3] [M5] [M6]") {
  PdoNode node(both_on());
  for (std::uint8_t sub = 1; sub <= 8; ++sub) {
    node.may_change(0x1600, sub);
  }
  node.may_change(0x1400, 1);
  const auto write_word = [&](std::uint32_t word) {
    CO_ERR err = CO_ERR_NONE;
    node.call([&] { err = CODictWrLong(&node->Dict, CO_DEV(0x1600, 1), word); });
    return err;
  };
  const auto write_number = [&](std::uint8_t number) {
    CO_ERR err = CO_ERR_NONE;
    node.call([&] { err = CODictWrByte(&node->Dict, CO_DEV(0x1600, 0), number); });
    return err;
  };
  const auto write_id = [&](std::uint32_t id) {
    node.call([&] { CHECK(CODictWrLong(&node->Dict, CO_DEV(0x1400, 1), id) == CO_ERR_NONE); });
  };
  CHECK(write_number(0) == CO_ERR_OBJ_ACC);
  CHECK(write_word(0x22010108) == CO_ERR_OBJ_ACC);
  write_id(0x80000201);
  CHECK(write_word(0x22010108) == CO_ERR_OBJ_ACC);
  CHECK(write_number(0) == CO_ERR_NONE);
  CHECK(write_word(0x22410108) == CO_ERR_OBJ_MAP_TYPE);
  CHECK(write_word(0x22040120) == CO_ERR_NONE);
  CHECK(write_number(9) == CO_ERR_OBJ_MAP_LEN);
  CHECK(write_number(1) == CO_ERR_NONE);
  write_id(0x201);
  node.start();
  node.rx("201#A1A2A3A4");
  CHECK(node.u32[0] == 0xA4A3A2A1);
}

// Repetition ----------------------------------------------------------------------------------------------------------

TEST_CASE("PDO mapping: after thirty new mappings one change sends one frame [D41]") {
  PdoNode node;
  node.start();
  for (unsigned times = 0; times < 30; ++times) {
    REQUIRE(node.remap_tpdo(0, {0x22110108, 0x22110208}, 0x40000181) == 0);
    REQUIRE(node.remap_rpdo(0, {0x22010108}, 0x201) == 0);
  }
  node.call([&] { COTPdoTrigObj(node->TPdo, node.find(0x2211, 1)); });
  node.tx("181#1121");
  CHECK(node.set(0x2211, 2, 1, 0x99) == 0);
  node.tx("181#1199");
  REQUIRE(node.remap_tpdo(0, {0x22010108}, 0x40000181) == 0);
  CHECK(node.set(0x2211, 2, 1, 0x77) == 0);
  node.silent();
  node.call([&] { COTPdoTrigObj(node->TPdo, node.find(0x2211, 1)); });
  node.silent();
  CHECK(node.error() == CO_ERR_TPDO_OBJ_TRIGGER);
}

TEST_CASE("PDO mapping: an object may be mapped twice into one PDO and into several PDOs [M5]") {
  PdoNode node;
  node.start();
  REQUIRE(node.remap_tpdo(0, {0x22020110, 0x22020110, 0x22020110, 0x22020110}, 0x40000181) == 0);
  node.trigger(0);
  node.tx("181#1112111211121112");
  REQUIRE(node.remap_rpdo(0, {0x22010108, 0x22010108}, 0x201) == 0);
  node.rx("201#A1A2");
  CHECK(node.u8[0] == 0xA2);
}

TEST_CASE("PDO mapping: a mapping that is changed while the PDO is off is kept by a reset communication [M1]") {
  PdoNode node(both_on());
  node.start();
  REQUIRE(node.remap_rpdo(0, {0x22040120}, 0x201) == 0);
  REQUIRE(node.remap_tpdo(0, {0x22040220}, 0x40000181) == 0);
  node.rx("000#8201");
  node.tx("701#00");
  node.start();
  node.rx("201#A1A2A3A4");
  CHECK(node.u32[0] == 0xA4A3A2A1);
  node.trigger(0);
  node.tx("181#21222324");
}

// PDO entries at indexes of PDOs that are not configured, or with a sub-index that the PDO does not have.
// [301:7.5.2.35-38]

#if USE_DICT_CHECK

#if CO_RPDO_N < 512 && CO_TPDO_N < 512

TEST_CASE("PDO place: an entry of a PDO beyond the configuration prevents the start of the node [D6]") {
  struct Beyond {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
  };
  std::uint32_t memory = 0x80000000;
  const Beyond entries[] = {{0x1400 + CO_RPDO_N, 1, CO_TPDO_ID},
                            {0x1400 + CO_RPDO_N, 5, CO_TPDO_EVENT},
                            {0x15FF, 2, CO_TPDO_TYPE},
                            {0x1600 + CO_RPDO_N, 0, CO_TPDO_NUM},
                            {0x17FF, 1, CO_TPDO_MAP},
                            {0x1800 + CO_TPDO_N, 1, CO_TPDO_ID},
                            {0x1800 + CO_TPDO_N, 5, CO_TPDO_EVENT},
                            {0x19FF, 3, CO_TPDO_INHIBIT},
                            {0x1A00 + CO_TPDO_N, 0, CO_TPDO_NUM},
                            {0x1BFF, 8, CO_TPDO_MAP},
                            {0x1400 + CO_RPDO_N, 1, CO_TUNSIGNED32}};
  for (const Beyond& one : entries) {
    CAPTURE(one.index);
    Fixture node(
        Setup().only_small().stay_in_init().with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}));
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.error() == CO_ERR_DICT_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_NOT_CONFIGURED);
    CHECK(CO_GET_DEV(key) == CO_DEV(one.index, one.sub));
  }
}

#endif

TEST_CASE("PDO place: a type of a PDO entry at a wrong index prevents the start of the node [D6]") {
  struct Wrong {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
  };
  std::uint64_t memory = 0;
  const Wrong entries[] = {{0x1400, 7, CO_TPDO_ID},    {0x2400, 1, CO_TPDO_ID},    {0x1800, 7, CO_TPDO_TYPE},
                           {0x2400, 2, CO_TPDO_TYPE},  {0x2400, 5, CO_TPDO_EVENT}, {0x1800, 8, CO_TPDO_EVENT},
                           {0x1400, 6, CO_TPDO_START}, {0x2400, 6, CO_TPDO_START}, {0x2400, 3, CO_TPDO_INHIBIT},
                           {0x2400, 0, CO_TPDO_NUM},   {0x1600, 65, CO_TPDO_MAP},  {0x2400, 1, CO_TPDO_MAP}};
  for (const Wrong& one : entries) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}); });
    CHECK(node.mode() == CO_INVALID);
    CHECK(node.error() == CO_ERR_DICT_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node->Dict, &key) == CO_DICT_WRONG_PLACE);
    CHECK(CO_GET_DEV(key) == CO_DEV(one.index, one.sub));
  }
}

#else

TEST_CASE("PDO place: without USE_DICT_CHECK entries of PDOs beyond the configuration access no PDO") {
  struct Beyond {
    std::uint16_t index;
    std::uint8_t sub;
    const CO_OBJ_TYPE* type;
    std::uint32_t value;
  };
  const Beyond entries[] = {{0x1400 + CO_RPDO_N, 1, CO_TPDO_ID, 0x80000181},
                            {0x15FF, 1, CO_TPDO_ID, 0x80000181},
                            {0x1800 + CO_TPDO_N, 1, CO_TPDO_ID, 0xC0000181},
                            {0x19FF, 1, CO_TPDO_ID, 0xC0000181},
                            {0x1400 + CO_RPDO_N, 2, CO_TPDO_TYPE, 254},
                            {0x19FF, 2, CO_TPDO_TYPE, 254},
                            {0x1400 + CO_RPDO_N, 5, CO_TPDO_EVENT, 10},
                            {0x15FF, 5, CO_TPDO_EVENT, 10},
                            {0x1800 + CO_TPDO_N, 5, CO_TPDO_EVENT, 10},
                            {0x19FF, 5, CO_TPDO_EVENT, 10},
                            {0x2405, 1, CO_TPDO_ID, 0xC0000181},
                            {0x25FF, 5, CO_TPDO_EVENT, 10}};
  for (const Beyond& one : entries) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    std::uint32_t memory = one.sub == 1 ? 0x80000000 : 0;
    PdoNode node({}, [&](Setup& setup) { setup.with({CO_KEY(one.index, one.sub, CO_OBJ_____RW), one.type, &memory}); });
    node.start();
    std::uint32_t value = one.value;
    CO_OBJ* const obj = CODictFind(&node->Dict, CO_DEV(one.index, one.sub));
    REQUIRE(obj != nullptr);
    const auto width = static_cast<std::uint8_t>(COObjGetSize(obj, &node.node, 0));
    CHECK(COObjWrValue(obj, &node.node, &value, width) == CO_ERR_NONE);
    CHECK(memory == one.value);
    for (const CO_PDO* pdo : {node->RPdo, node->TPdo}) {
      CHECK_FALSE(pdo->Node == nullptr);
      CHECK(pdo->Map.Length == 0);
      CHECK(pdo->Tmr.Running == 0);
    }
    node.rx("000#8201");
    node.tx("701#00");
  }
}

#endif

}  // namespace
