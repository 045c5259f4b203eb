// SPDX-License-Identifier: Apache-2.0
// Configuration of multiplex PDOs: FEh and FFh in sub-index 0 of the mapping [301:7.5.2.36, 7.5.2.38], the object
// scanner list [301:7.5.2.39] and the object dispatching list [301:7.5.2.40].
#include "lexican/dictionary.hpp"
#include "support/mpdo_fixture.hpp"

#if CO_MPDO_N > 0 && CO_RPDO_N > 0 && CO_TPDO_N > 0

namespace {

using namespace test;

constexpr std::uint32_t abort_access = 0x06010000;
constexpr std::uint32_t abort_no_object = 0x06020000;
constexpr std::uint32_t abort_not_mappable = 0x06040041;
constexpr std::uint32_t abort_too_long = 0x06040042;
constexpr std::uint32_t abort_incompatible = 0x06040043;
constexpr std::uint32_t abort_range = 0x06090030;

void without_lists(Setup& setup) {
  for (const std::uint16_t index :
       {std::uint16_t{0x1FA0}, std::uint16_t{0x1FA1}, std::uint16_t{0x1FD0}, std::uint16_t{0x1FD1}}) {
    for (std::uint8_t sub = 0; sub <= 4; ++sub) {
      setup.without(index, sub);
    }
  }
}

// Sub 0 ---------------------------------------------------------------------------------------------------------------

TEST_CASE("MPDO configuration: the re-mapping procedure works for all four kinds [M1]") {
  MpdoNode node;
  node.start();
  CHECK(node.set(0x1FD0, 1, 8, 0x0122010160000105) == 0);
  CHECK(node.set(0x1FA0, 1, 4, 0x01220102) == 0);
  for (const std::uint8_t kind : {sam, dam}) {
    CAPTURE(unsigned{kind});
    CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
    CHECK(node.set(0x1600, 0, 1, 0) == 0);
    CHECK(node.set(0x1600, 0, 1, kind) == 0);
    CHECK(node.get(0x1600, 0) == kind);
    CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
    CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
    CHECK(node.set(0x1A00, 0, 1, 0) == 0);
    CHECK(node.set(0x1A00, 0, 1, kind) == 0);
    CHECK(node.get(0x1A00, 0) == kind);
    CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
    node.rx(kind == sam ? "201#05006001A1000000" : "201#81012201B1000000");
    CHECK(node.u8[0] == (kind == sam ? 0xA1 : 0xB1));
    if (kind == sam) {
      CHECK(node.request(0) == CO_ERR_NONE);
      node.tx("181#0101220221000000");
    } else {
      CHECK(node.send_to(0, 5, CO_DEV(0x6200, 1), 0x42) == CO_ERR_NONE);
      node.tx("181#8500620142000000");
    }
  }
  REQUIRE(node.remap_rpdo(0, {0x22010108}, 0x201) == 0);
  node.rx("201#C1");
  CHECK(node.u8[0] == 0xC1);
  REQUIRE(node.remap_tpdo(0, {0x22010108}, 0x40000181) == 0);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#C1");
}

TEST_CASE("MPDO configuration: without lists source addressing is refused with 0604 0042h and sub 0 is 0 [M6] [M7]") {
  MpdoNode node({}, without_lists);
  node.ask("601#2F001600FE000000", "581#8000160042000406");
  node.ask("601#2F001A00FE000000", "581#80001A0042000406");
  CHECK(node.get(0x1600, 0) == 0);
  CHECK(node.get(0x1A00, 0) == 0);
  node.ask("601#2F001600FF000000", "581#6000160000000000");
  node.ask("601#2F001A00FF000000", "581#60001A0000000000");
}

TEST_CASE("MPDO configuration: numbers between CO_PDO_MAP_N and FEh are refused with 0604 0042h [M6]") {
  MpdoNode node;
  for (unsigned number = CO_PDO_MAP_N + 1; number < 0xFE; ++number) {
    CAPTURE(number);
    CHECK(node.set(0x1600, 0, 1, number) == abort_too_long);
    CHECK(node.set(0x1A00, 0, 1, number) == abort_too_long);
  }
}

TEST_CASE("MPDO configuration: PDOs that are not event-driven are refused with 0604 0043h and sub 0 is 0 [301:7.2.3]") {
  MpdoNode node;
  for (unsigned type = 0; type <= 255; ++type) {
    CAPTURE(type);
    if (node.set(0x1400, 2, 1, type) == 0) {
      const std::uint32_t expected = type >= 254 ? 0 : abort_incompatible;
      CHECK(node.set(0x1600, 0, 1, dam) == expected);
      CHECK(node.get(0x1600, 0) == (expected == 0 ? dam : 0));
      CHECK(node.set(0x1600, 0, 1, sam) == expected);
    }
    if (node.set(0x1800, 2, 1, type) == 0) {
      const std::uint32_t expected = type >= 254 ? 0 : abort_incompatible;
      CHECK(node.set(0x1A00, 0, 1, dam) == expected);
      CHECK(node.set(0x1A00, 0, 1, sam) == expected);
      CHECK(node.get(0x1A00, 0) == (expected == 0 ? sam : 0));
    }
  }
}

TEST_CASE("MPDO configuration: switching on a PDO with a type that is not event-driven is refused [301:7.2.3] [P6]") {
  if (USE_SYNC == 0) {
    return;
  }
  MpdoNode node;
  CHECK(node.set(0x1600, 0, 1, dam) == 0);
  CHECK(node.set(0x1400, 2, 1, 1) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == abort_range);
  CHECK(node.set(0x1400, 2, 1, 254) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
  CHECK(node.set(0x1400, 2, 1, 1) == abort_range);
  CHECK(node.get(0x1400, 2) == 254);
  CHECK(node.set(0x1400, 2, 1, 255) == 0);
  CHECK(node.set(0x1A00, 0, 1, sam) == 0);
  CHECK(node.set(0x1800, 2, 1, 0) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == abort_range);
  CHECK(node.set(0x1800, 2, 1, 255) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(node.set(0x1800, 2, 1, 240) == abort_range);
  CHECK(node.set(0x1800, 2, 1, 254) == 0);
}

TEST_CASE("MPDO configuration: sub 0 and entries are written like those of any PDO [M2] [M3]") {
  MpdoTable table;
  table.rpdo[0].on(0x201, 255, {}).number = dam;
  MpdoNode node(table);
  CHECK(node.set(0x1600, 0, 1, dam) == abort_access);
  CHECK(node.set(0x1600, 0, 1, 0) == abort_access);
  CHECK(node.set(0x1600, 1, 4, 0x22010108) == abort_access);
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1600, 1, 4, 0x22010108) == abort_access);
  CHECK(node.set(0x1600, 0, 1, 0) == 0);
  CHECK(node.set(0x1600, 1, 4, 0x22010108) == 0);
  CHECK(node.set(0x1600, 0, 1, dam) == 0);
}

TEST_CASE("MPDO configuration: a second TPDO with the scanner list is refused [301:7.2.3]") {
  if (fixture_tpdos < 2) {
    return;
  }
  MpdoTable table;
  table.scan[0] = 0x01220101;
  MpdoNode node(table);
  CHECK(node.set(0x1A00, 0, 1, sam) == 0);
  CHECK(node.set(0x1A01, 0, 1, sam) == 0);
  CHECK(node.set(0x1801, 1, 4, 0x40000281) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == abort_range);
  CHECK(node.set(0x1A00, 0, 1, 0) == 0);
  CHECK(node.set(0x1A00, 0, 1, sam) == abort_incompatible);
  CHECK(node.get(0x1A00, 0) == 0);
  node.start();
  CHECK(node.request(1) == CO_ERR_NONE);
  node.tx("281#0101220111000000");
  CHECK(node.set(0x1801, 1, 4, 0xC0000281) == 0);
  CHECK(node.set(0x1A00, 0, 1, sam) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220111000000");
}

TEST_CASE("MPDO configuration: the first of two TPDOs with source addressing in the table exists, also after resets") {
  if (fixture_tpdos < 2) {
    return;
  }
  MpdoTable table;
  table.scan[0] = 0x01220101;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  table.tpdo[1].on(0x40000281, 255, {}).number = sam;
  MpdoNode node(table);
  for (const char* const command : {"000#0101", "000#8201", "000#8101"}) {
    node.rx(command);
    node.frames();
    node.rx("000#0101");
    CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);
    CHECK(node.request(1) == CO_ERR_TPDO_COM_OBJ);
    CHECK(node.request(0) == CO_ERR_NONE);
    node.tx("181#0101220111000000");
  }
}

TEST_CASE("MPDO configuration: after a reset another TPDO may use the scanner list") {
  if (fixture_tpdos < 2) {
    return;
  }
  MpdoTable table;
  table.scan[0] = 0x01220101;
  table.tpdo[0].on(0xC0000181, 255, {}).number = sam;
  table.tpdo[1].on(0x40000281, 255, {}).number = sam;
  MpdoNode node(table);
  node.may_change(0x1800, 1);
  node.may_change(0x1801, 1);
  node.tpdo[0].cob_id = 0x40000181;  // simulates stored parameters
  node.tpdo[1].cob_id = 0xC0000281;
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220111000000");
}

TEST_CASE("MPDO configuration: CODictInit() with another table adds or removes the TPDO of the scanner list") {
  if (fixture_tpdos < 2) {
    return;
  }
  for (const bool given : {true, false}) {
    CAPTURE(given);
    MpdoTable table;
    table.scan[0] = 0x01220101;
    table.tpdo[0].on(0x40000181, 255, {0x22010108});
    table.tpdo[0].number = given ? 1 : sam;
    MpdoNode node(table);
    std::vector<CO_OBJ> other(node.node.Dict.Root, node.node.Dict.Root + node.node.Dict.Num);
    std::uint8_t number = given ? sam : 1;
    for (CO_OBJ& obj : other) {
      obj.Data = CO_GET_DEV(obj.Key) == CO_DEV(0x1A00, 0) ? CO_DATA(&number) : obj.Data;
    }
    CHECK(node.set(0x1A01, 0, 1, sam) == (given ? 0 : abort_incompatible));
    node.call(
        [&] { (void)CODictInit(&node.node.Dict, &node.node, other.data(), static_cast<std::uint16_t>(other.size())); });
    CHECK(node.set(0x1A01, 0, 1, 0) == 0);
    CHECK(node.set(0x1A01, 0, 1, sam) == (given ? abort_incompatible : 0));
  }
}

TEST_CASE("MPDO configuration: PDOs with a wrong configuration in the table do not exist [M9]") {
  struct Wrong {
    std::uint8_t number;
    std::uint8_t type;
    std::uint32_t scan;
    std::uint64_t dispatch;
  };
  const Wrong all[] = {
      {dam, 1, 0, 0},
      {sam, 1, 0, 0},
      {0xFD, 255, 0, 0},
      {sam, 255, 0x01300001, 0x0130000160000105},
      {sam, 255, 0x09220101, 0x0922010160000105},
      {sam, 255, 0x01220501, 0x0122050160000105},
  };
  for (const Wrong& one : all) {
    CAPTURE(unsigned{one.number});
    CAPTURE(one.scan);
    MpdoTable table;
    table.scan[1] = one.scan;
    table.dispatch[1] = one.dispatch;
    table.rpdo[0].on(0x201, one.type, {}).number = one.number;
    table.tpdo[0].on(0x40000181, one.type, {}).number = one.number;
    MpdoNode node(table);
    CHECK(node.error() != CO_ERR_NONE);
    node.start();
    node.rx("201#81012201A1000000");
    CHECK(node.counters().Unclaimed == 1);
    CHECK(node.u8[0] == 0x11);
    CHECK(node.request(0) == CO_ERR_TPDO_COM_OBJ);
    node.silent();
  }
}

// Lists ---------------------------------------------------------------------------------------------------------------

struct Row {
  std::uint64_t entry;
  std::uint32_t abort;
};

TEST_CASE("MPDO scanner list: entries must be objects that a TPDO can map, of up to 4 bytes [301:7.5.2.39] [M4] [M5]") {
  const Row rows[] = {
      {0x01220101, 0},                   // UNSIGNED8
      {0x00220301, 0},                   // UNSIGNED24; block size 0 is one object
      {0x08220401, 0},                   // UNSIGNED32, sub 1…8
      {0x01225401, 0},                   // REAL32
      {0x01222101, 0},                   // read-only
      {0, 0},                            // unused entry
      {0x01300001, abort_no_object},     // no such index
      {0x00000001, abort_no_object},     // index 0
      {0x01220109, abort_not_mappable},  // no such sub-index
      {0x01224101, abort_not_mappable},  // not mappable
      {0x01223101, abort_not_mappable},  // write-only
      {0x01220501, abort_not_mappable},  // 5 bytes
      {0x01220801, abort_not_mappable},  // 8 bytes
      {0x01000500, abort_no_object},     // a static data type
      {0x09220401, abort_not_mappable},  // sub-index 9 of the block is missing
      {0x02220408, abort_not_mappable},
      {0x022204FF, abort_range},  // a block beyond sub-index 255
      {0xFF220402, abort_range},
  };
  MpdoNode node;
  for (const Row& row : rows) {
    CAPTURE(row.entry);
    CHECK(node.set(0x1FA0, 1, 4, 0x01220102) == 0);
    CHECK(node.set(0x1FA0, 1, 4, row.entry) == row.abort);
    CHECK(node.get(0x1FA0, 1) == (row.abort == 0 ? row.entry : 0x01220102));
  }
  CHECK(node.set(0x1FA0, 1, 2, 0x2201) == 0x06070013);
}

TEST_CASE(
    "MPDO dispatching list: local objects must be objects that an RPDO can map, of up to 4 bytes [301:7.5.2.40] [M4]") {
  const Row rows[] = {
      {0x0122010160000105, 0},
      {0x0022030160000101, 0},
      {0x082204016000F87F, 0},  // sub F8h…FFh to sub 1…8
      {0x0122310160000105, 0},  // write-only
      {0, 0},
      {0x0130000160000105, abort_no_object},
      {0x0000000060000105, abort_no_object},
      {0x0122010960000105, abort_not_mappable},
      {0x0122410160000105, abort_not_mappable},
      {0x0122210160000105, abort_not_mappable},  // read-only
      {0x0122050160000105, abort_not_mappable},
      {0x0122080160000105, abort_not_mappable},
      {0x0100050060000105, abort_no_object},     // a static data type
      {0x0922040160000105, abort_not_mappable},  // sub-index 9 is missing
      {0x022204FF60000105, abort_range},
      {0x082204016000F97F, abort_range},  // the producer's block ends beyond sub-index 255
      {0x0122010160000100, abort_range},  // node-ID 0
      {0x0122010160000180, abort_range},  // node-ID 128
      {0x01220101600001FF, abort_range},
  };
  MpdoNode node;
  for (const Row& row : rows) {
    CAPTURE(row.entry);
    CHECK(node.set(0x1FD0, 1, 8, 0x0122010260000105) == 0);
    CHECK(node.set(0x1FD0, 1, 8, row.entry) == row.abort);
    CHECK(node.get(0x1FD0, 1) == (row.abort == 0 ? row.entry : 0x0122010260000105));
  }
}

TEST_CASE("MPDO scanner list: more objects than the node can store are refused with 0604 0042h [301:7.5.2.39]") {
  static_assert(CO_MPDO_N == 16);
  MpdoNode node;
  CHECK(node.set(0x1FA0, 1, 4, 0x08220101) == 0);
  CHECK(node.set(0x1FA1, 1, 4, 0x08220201) == 0);
  CHECK(node.set(0x1FA0, 2, 4, 0x01220401) == abort_too_long);
  CHECK(node.get(0x1FA0, 2) == 0);
  CHECK(node.set(0x1FA1, 1, 4, 0x07220201) == 0);
  CHECK(node.set(0x1FA0, 2, 4, 0x02220401) == abort_too_long);
  CHECK(node.set(0x1FA0, 2, 4, 0x01220401) == 0);
}

TEST_CASE("MPDO scanner list: a refused entry leaves the list unchanged [301:7.5.2.39]") {
  MpdoTable table;
  table.scan = {0x08220101, 0x04220201, 0x04220401};
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  MpdoNode node(table);
  node.frames_per_call(16);
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  const std::vector<std::string> sent = node.frames();
  CHECK(sent.size() == 16);
  CHECK(node.set(0x1FA0, 2, 4, 0x08220201) == abort_too_long);
  CHECK(node.request(0) == CO_ERR_NONE);
  CHECK(node.frames() == sent);
}

TEST_CASE("MPDO scanner list: missing space is reported before any other error [301:7.5.2.39]") {
  MpdoTable table;
  table.scan = {0x01300001, 0x08220101, 0x08220201};
  MpdoNode node(table);
  CHECK(node.set(0x1FA0, 4, 4, 0x01220401) == abort_too_long);
  CHECK(node.get(0x1FA0, 4) == 0);
}

TEST_CASE("MPDO dispatching list: more entries than the node can store are refused with 0604 0042h [301:7.5.2.40]") {
  static_assert(CO_MPDO_N == 16);
  std::array<std::uint64_t, 17> list{};
  MpdoNode node({}, [&](Setup& setup) {
    for (std::uint8_t n = 0; n < list.size(); ++n) {
      setup.with({CO_KEY(0x1FD0, n + 1, CO_OBJ_____RW), CO_TPDO_DISPATCH, CO_DATA(&list[n])});
    }
  });
  for (unsigned n = 0; n < list.size(); ++n) {
    CHECK(node.set(0x1FD0, static_cast<std::uint8_t>(n + 1), 8, 0x0122010160000005 | n << 8) ==
          (n < 16 ? 0 : abort_too_long));
  }
  CHECK(list[16] == 0);
  CHECK(node.set(0x1FD0, 3, 8, 0) == 0);
  CHECK(node.set(0x1FD0, 17, 8, 0x0122010260006005) == 0);
}

TEST_CASE("MPDO lists: entries of basic types are read when the PDO is switched on") {
  MpdoTable table;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  table.rpdo[0].on(0x201, 255, {}).number = sam;
  std::uint32_t scan = 0x01220101;
  std::uint64_t dispatch = 0x0122010260000105;
  MpdoNode node(table, [&](Setup& setup) {
    setup.with({CO_KEY(0x1FA0, 1, CO_OBJ_____RW), CO_TUNSIGNED32, CO_DATA(&scan)});
    setup.with({CO_KEY(0x1FD0, 1, CO_OBJ_____RW), CO_TUNSIGNED64, CO_DATA(&dispatch)});
  });
  node.start();
  CHECK(node.set(0x1FA0, 1, 4, 0x01220103) == 0);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220111000000");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220331000000");
  node.rx("201#05006001A1000000");
  CHECK(node.u8[1] == 0xA1);
}

TEST_CASE("MPDO lists: 1FCFh and 1FFFh are the last indices; the next one is no list [301:7.5.2.39-40]") {
  MpdoTable table;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  table.rpdo[0].on(0x201, 255, {}).number = sam;
  table.scan[0] = 0x01220101;
  table.dispatch[0] = 0x0122010160000105;
  std::uint32_t last_scan = 0x01220102;
  std::uint32_t no_scan = 0x01220103;
  std::uint64_t last_dispatch = 0x0122010260000205;
  std::uint64_t no_dispatch = 0x0122010360000305;
  MpdoNode node(table, [&](Setup& setup) {
    setup.with({CO_KEY(0x1FCF, 254, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&last_scan)});
    setup.with({CO_KEY(0x1FFF, 254, CO_OBJ_____RW), CO_TPDO_DISPATCH, CO_DATA(&last_dispatch)});
    setup.with({CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TUNSIGNED64, CO_DATA(&no_dispatch)});
  });
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  node.frames_per_call(2);
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx({"181#0101220111000000", "181#0101220221000000"});
  node.rx("201#05006002A2000000");
  CHECK(node.u8[1] == 0xA2);
  node.rx("201#05006003A3000000");
  CHECK(node.u8[2] == 0x31);

  MpdoNode without_dispatching(table, [&](Setup& setup) {
    setup.with({CO_KEY(0x1FCF, 254, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&last_scan)});
    for (std::uint8_t sub = 0; sub <= 4; ++sub) {
      setup.without(0x1FD0, sub).without(0x1FD1, sub);
    }
    setup.with({CO_KEY(0x1FD0, 1, CO_OBJ_____RW), CO_TUNSIGNED32, CO_DATA(&no_scan)});
  });
  without_dispatching.start();
  without_dispatching.frames_per_call(3);
  CHECK(without_dispatching.request(0) == CO_ERR_NONE);
  without_dispatching.tx({"181#0101220111000000", "181#0101220221000000"});
}

// Macros for entries of the lists, checked at compile time.

static_assert(CO_MPDO_SCAN(3, 0x2201, 4) == 0x03220104);
static_assert(CO_MPDO_DISPATCH(3, 0x2201, 4, 0x6000, 0xFD, 5) == 0x032201046000FD05);

namespace rules = co::rules;
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FA0, 1, CO_OBJ_D___R_), true) == CO_DICT_OK);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FCF, 254, CO_OBJ_____RW), true) == CO_DICT_OK);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FCF, 255, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FD0, 1, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1F9F, 1, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FA0, 0, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FA0, 1, CO_OBJ__N__RW), true) == CO_DICT_NODEID_TYPE);
static_assert(rules::check_type(rules::pdo_scan, CO_KEY(0x1FA0, 1, CO_OBJ_____RW), false) == CO_DICT_NO_DATA);
static_assert(rules::check_type(rules::pdo_dispatch, CO_KEY(0x1FD0, 1, CO_OBJ_____RW), true) == CO_DICT_OK);
static_assert(rules::check_type(rules::pdo_dispatch, CO_KEY(0x1FFF, 254, CO_OBJ_____RW), true) == CO_DICT_OK);
static_assert(rules::check_type(rules::pdo_dispatch, CO_KEY(0x1FCF, 1, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_dispatch, CO_KEY(0x2000, 1, CO_OBJ_____RW), true) == CO_DICT_WRONG_PLACE);
static_assert(rules::check_type(rules::pdo_dispatch, CO_KEY(0x1FD0, 1, CO_OBJ_D___R_), true) ==
              (sizeof(void*) >= 8 ? CO_DICT_OK : CO_DICT_DIRECT_TYPE));

std::uint64_t constant_dispatch = CO_MPDO_DISPATCH(1, 0x2000, 0, 0x6000, 1, 5);
std::uint8_t constant_value = 0x42;

constexpr CO_OBJ constant_table[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0xFF)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0xFE)},
    {CO_KEY(0x1FA0, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1FA0, 1, CO_OBJ_D___R_), CO_TPDO_SCAN, (CO_DATA)(CO_MPDO_SCAN(1, 0x2000, 0))},
    {CO_KEY(0x1FD0, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1FD0, 1, CO_OBJ_____RW), CO_TPDO_DISPATCH, (CO_DATA)(&constant_dispatch)},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&constant_value)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(constant_table);

TEST_CASE("MPDO lists: values may be stored in the entries (flag D)") {
  MpdoTable table;
  table.tpdo[0].on(0x40000181, 255, {}).number = sam;
  MpdoNode node(table, [](Setup& setup) {
    setup.with({CO_KEY(0x1FA0, 1, CO_OBJ_D___R_), CO_TPDO_SCAN, CO_DATA(0x01220103)});
  });
  node.start();
  CHECK(node.request(0) == CO_ERR_NONE);
  node.tx("181#0101220331000000");
}

#if USE_DICT_CHECK

TEST_CASE("MPDO lists: their types are accepted at their indices only") {
  std::uint32_t word = 0;
  std::uint64_t longer = 0;
  const CO_OBJ wrong[] = {
      {CO_KEY(0x1F9F, 1, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&word)},
      {CO_KEY(0x1FA0, 0, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&word)},
      {CO_KEY(0x1FD0, 1, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&word)},
      {CO_KEY(0x1FA0, 1, CO_OBJ_____RW), CO_TPDO_DISPATCH, CO_DATA(&longer)},
      {CO_KEY(0x2000, 1, CO_OBJ_____RW), CO_TPDO_DISPATCH, CO_DATA(&longer)},
  };
  for (const CO_OBJ& entry : wrong) {
    CAPTURE(entry.Key);
    MpdoNode node({}, [&](Setup& setup) { setup.with(entry).stay_in_init(); });
    CHECK(node.error() == CO_ERR_DICT_INIT);
    std::uint32_t key = 0;
    CHECK(CODictGetFault(&node.node.Dict, &key) == CO_DICT_WRONG_PLACE);
    CHECK(key == entry.Key);
  }
}

#endif

}  // namespace

#endif
