// SPDX-License-Identifier: Apache-2.0
// PDOs with constant parameters in the dictionary, which are checked at start like writes of the network. A wrong
// parameter makes only its PDO invalid. [301:7.5.2.35-38]
#include "lexican/dictionary.hpp"
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

/// All entries of 1600h or 1A00h, as constants.
struct Constant {
  std::uint16_t index;
  std::uint32_t number;
  std::vector<std::uint32_t> words;

  void add_to(Setup& setup) const {
    setup.with({CO_KEY(index, 0, CO_OBJ_D___R_), CO_TPDO_NUM, number});
    std::uint8_t sub = 1;
    for (const std::uint32_t word : words) {
      setup.with({CO_KEY(index, sub++, CO_OBJ_D___R_), CO_TPDO_MAP, word});
    }
    for (; sub <= CO_PDO_MAP_N; ++sub) {
      setup.without(index, sub);
    }
  }
};

/// A node whose RPDO 0 and TPDO 0 are described by \a constants. RPDO 1 and TPDO 1, if configured, are valid.
struct Static : PdoNode {
  explicit Static(const std::vector<Constant>& constants, std::uint32_t rpdo_id = 0x201,
                  std::uint32_t tpdo_id = 0x40000181, std::uint8_t rpdo_type = 255, std::uint8_t tpdo_type = 254)
      : PdoNode(second_on(), [&](Setup& setup) {
          setup.with({CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, rpdo_id});
          setup.with({CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, rpdo_type});
          setup.with({CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TPDO_ID, tpdo_id});
          setup.with({CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, tpdo_type});
          for (const Constant& one : constants) {
            one.add_to(setup);
          }
        }) {}

  static PdoTable second_on() {
    PdoTable table;
    table.rpdo[1].on(0x301, 255, {0x22010808});
    table.tpdo[1].on(0x40000281, 254, {0x22020810});
    return table;
  }

  /// Checks that RPDO 1, TPDO 1 and SDO work.
  void check_others() {
    rx("000#0101");
    silent();
    if (fixture_rpdos > 1) {
      u8[7] = 0;
      rx("301#5A");
      CHECK(u8[7] == 0x5A);
    }
    if (fixture_tpdos > 1) {
      trigger(1);
      tx("281#8182");
    }
    ask("601#4000100000000000", "581#4300100091010F00");
  }

  /// Checks that RPDO 0 ignores frames of every length.
  void check_no_rpdo() {
    const PdoVariables before;
    for (const char* frame : {"201#", "201#F1", "201#F1F2", "201#F1F2F3F4F5F6F7F8", "000#F1F2F3F4F5F6F7F8"}) {
      rx(frame);
      silent();
      CHECK(std::equal(before.u8, before.u8 + 7, u8));
      CHECK(std::equal(before.u16, before.u16 + 8, u16));
      CHECK(std::equal(before.u32, before.u32 + 8, u32));
      CHECK(std::equal(before.u64, before.u64 + 8, u64));
    }
  }

  void check_no_tpdo() {
    CHECK(request(0) == CO_ERR_TPDO_COM_OBJ);
    trigger(0);
    silent();
  }
};

constexpr std::uint32_t two_bytes[] = {0x22010108, 0x22010208};

const Constant right_rpdo{0x1600, 2, {two_bytes[0], two_bytes[1]}};
const Constant right_tpdo{0x1A00, 2, {two_bytes[0], two_bytes[1]}};

TEST_CASE("PDO static: a correct one works [M9]") {
  Static node({right_rpdo, right_tpdo});
  CHECK(node.error() == CO_ERR_NONE);
  node.check_others();
  node.rx("201#A1A2");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u8[1] == 0xA2);
  node.trigger(0);
  node.tx("181#A1A2");
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0x06010002);
  CHECK(node.set(0x1600, 0, 1, 0) == 0x06010002);
  CHECK(node.set(0x1A00, 1, 4, 0) == 0x06010002);
}

TEST_CASE("PDO static: one with bit 31 is off and not an error [M9]") {
  Static node({{0x1600, 0, {}}, {0x1A00, 200, {0x30000108}}}, 0x80000201, 0xC0000181);
  CHECK(node.error() == CO_ERR_NONE);
  node.check_others();
  node.check_no_rpdo();
  node.check_no_tpdo();
}

const std::vector<std::uint32_t> nine(9, 0x22010108);

/// Mappings that are invalid for RPDOs and TPDOs.
const Constant wrong_mappings[] = {
    {0, 0, {0x22010108}},
    {0, 1, {}},
    {0, 2, {0x22010108}},
    {0, 200, {0x22010108, 0x22010208}},
    {0, 0xFE, {0x22010108}},
#if CO_MPDO_N == 0
    {0, 0xFF, {0x22010108}},
#endif
    {0, 9, nine},
    {0, 8, {0x22010108, 0x22010208, 0x22010308, 0x22010408, 0x22010508, 0x22010608, 0x22010708}},
    {0, 2, {0x22080140, 0x22010108}},
    {0, 3, {0x22040120, 0x22040220, 0x22010108}},
    {0, 8, std::vector<std::uint32_t>(8, 0x22080140)},
    {0, 1, {0x00000000}},
    {0, 3, {0x22010108, 0x00000000, 0x22010208}},
    {0, 8, std::vector<std::uint32_t>(8, 0x22010100)},
    {0, 1, {0x22010100}},
    {0, 1, {0x22010110}},
    {0, 1, {0x22010104}},
    {0, 1, {0x22020108}},
    {0, 1, {0x220101FF}},
    {0, 1, {0x22080141}},
    {0, 1, {0x30000108}},
    {0, 2, {0x22010108, 0x30000108}},
    {0, 1, {0x22010908}},
    {0, 1, {0x00020010}},
    {0, 1, {0x00020108}},
    {0, 1, {0x00080020}},
    {0, 1, {0xFFFFFFFF}},
};

TEST_CASE("PDO static: a wrong mapping disables the RPDO and sets the node error [M9] [D37]") {
  std::vector<Constant> wrong(std::begin(wrong_mappings), std::end(wrong_mappings));
  wrong.push_back({0, 1, {0x22210108}});  // read-only
  wrong.push_back({0, 2, {0x22010108, 0x22220110}});
  wrong.push_back({0, 9, std::vector<std::uint32_t>(9, 0x00050008)});
  wrong.push_back({0, 3, {0x00070020, 0x00070020, 0x00020008}});
  for (Constant& one : wrong) {
    one.index = 0x1600;
    CAPTURE(one.number);
    CAPTURE((one.words.empty() ? 0 : one.words[0]));
    Static node({one, right_tpdo});
    CHECK(node.error() == CO_ERR_RPDO_MAP_OBJ);
    node.check_others();
    node.check_no_rpdo();
    node.trigger(0);
    node.tx("181#1121");
  }
}

TEST_CASE("PDO static: a wrong mapping disables the TPDO and sets the node error [M9] [D36] [D37]") {
  std::vector<Constant> wrong(std::begin(wrong_mappings), std::end(wrong_mappings));
  wrong.push_back({0, 1, {0x22310108}});  // write-only
  wrong.push_back({0, 2, {0x22010108, 0x22320110}});
  wrong.push_back({0, 1, {0x00050008}});  // dummy
  wrong.push_back({0, 2, {0x22010108, 0x00070020}});
  for (Constant& one : wrong) {
    one.index = 0x1A00;
    CAPTURE(one.number);
    CAPTURE((one.words.empty() ? 0 : one.words[0]));
    Static node({right_rpdo, one});
    CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);
    node.check_others();
    node.check_no_tpdo();
    node.rx("201#A1A2");
    CHECK(node.u8[0] == 0xA1);
  }
}

TEST_CASE("PDO static: without entries of the mapping a PDO does not exist [M9]") {
  const auto without = [](Setup& setup, std::uint16_t index) {
    for (std::uint8_t sub = 0; sub <= CO_PDO_MAP_N; ++sub) {
      setup.without(index, sub);
    }
  };
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108});
  table.tpdo[0].on(0x40000181, 254, {0x22010108});
  {
    PdoNode node(table, [&](Setup& setup) { without(setup, 0x1600); });
    CHECK(node.error() == CO_ERR_RPDO_MAP_OBJ);
    node.start();
    node.rx("201#A1");
    CHECK(node.u8[0] == 0x11);
    node.trigger(0);
    node.tx("181#11");
  }
  {
    PdoNode node(table, [&](Setup& setup) { without(setup, 0x1A00); });
    CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);
    node.start();
    node.rx("201#A1");
    CHECK(node.u8[0] == 0xA1);
    node.trigger(0);
    node.silent();
  }
}

TEST_CASE("PDO static: a COB-ID that cannot be written by SDO disables the PDO [M9] [P4] [P5]") {
  for (const std::uint32_t id : {0x00000000U, 0x00000001U, 0x0000007FU, 0x00000101U, 0x00000180U, 0x00000581U,
                                 0x00000601U, 0x0000067FU, 0x000006E0U, 0x000006FFU, 0x00000701U, 0x000007FFU,
                                 0x00000800U, 0x00000A01U, 0x10000201U, 0x1FFFFFFFU, 0x20000000U}) {
    if (CO_RESTRICTED_IDS != 0 && id != 0 && id <= 0x7FF) {
      continue;
    }
    CAPTURE(id);
    {
      Static node({right_rpdo, right_tpdo}, id);
      CHECK(node.error() == CO_ERR_RPDO_COM_OBJ);
      node.check_others();
      node.check_no_rpdo();
      node.trigger(0);
      node.tx("181#1121");
    }
    {
      Static node({right_rpdo, right_tpdo}, 0x201, id | 0x40000000);
      CHECK(node.error() == CO_ERR_TPDO_COM_OBJ);
      node.check_others();
      node.check_no_tpdo();
      node.rx("201#A1A2");
      CHECK(node.u8[0] == 0xA1);
    }
  }
}

TEST_CASE("PDO static: a COB-ID that is restricted with the node-ID added disables the PDO [M9] [P5]") {
  if (CO_RESTRICTED_IDS != 0) {
    return;
  }
  PdoNode node({}, [](Setup& setup) {
    setup.with({CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, 0x700});
    setup.with({CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, 0xC0000180});
    right_rpdo.add_to(setup);
  });
  CHECK(node.error() == CO_ERR_RPDO_COM_OBJ);
  node.start();
  node.rx("701#A1A2");
  node.frames();  // 701h is the heartbeat of the node: it may report the collision
  CHECK(node.u8[0] == 0x11);
}

TEST_CASE("PDO static: a transmission type that cannot be written by SDO disables the PDO [M9] [P7] [P8]") {
  for (unsigned type = 241; type <= 253; ++type) {
    CAPTURE(type);
    Static node({right_rpdo, right_tpdo}, 0x201, 0x40000181, static_cast<std::uint8_t>(type));
    CHECK(node.error() == CO_ERR_RPDO_COM_OBJ);
    node.check_others();
    node.check_no_rpdo();
  }
  const unsigned last = USE_PDO_RTR != 0 ? 251 : 253;
  for (unsigned type = 241; type <= last; ++type) {
    CAPTURE(type);
    Static node({right_rpdo, right_tpdo}, 0x201, 0x40000181, 255, static_cast<std::uint8_t>(type));
    CHECK(node.error() == CO_ERR_TPDO_COM_OBJ);
    node.check_others();
    node.check_no_tpdo();
  }
}

// Static mappings of 2241h:1 and 2242h:1, which have no flag P --------------------------------------------------------

constexpr std::uint32_t abort_not_mappable = 0x06040041;

/// Returns a table with RPDO 0 on 201h and TPDO 0 on 181h, which map objects without flag P and are writable by the
/// network.
PdoTable without_flag_p() {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, 0x22410108});
  table.tpdo[0].on(0x40000181, 254, {0x22420110, 0x22410108});
  return table;
}

void check_works(PdoNode& node) {
  node.start();
  node.n8 = 0;
  node.rx("201#A1A2");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.n8 == 0xA2);
  node.trigger(0);
  node.tx("181#1112A2");
}

TEST_CASE("PDO static: constant entries may map objects without flag P") {
  Static node({{0x1600, 2, {0x22010108, 0x22410108}}, {0x1A00, 2, {0x22420110, 0x22410108}}});
  CHECK(node.error() == CO_ERR_NONE);
  node.check_others();
  check_works(node);
}

TEST_CASE("PDO static: objects without flag P work after resets and after the PDO was off") {
  PdoNode node(without_flag_p());
  CHECK(node.error() == CO_ERR_NONE);
  check_works(node);
  for (const std::string reset : {"000#8201", "000#8101"}) {
    CAPTURE(reset);
    node.rx(reset);
    node.tx("701#00");
    CHECK(node.error() == CO_ERR_NONE);
    check_works(node);
    CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
    CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
    node.rx("201#B1B2");
    CHECK(node.n8 == 0xA2);
    CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
    CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
    check_works(node);
  }
}

TEST_CASE("PDO static: SDO cannot map objects without flag P, also if the table maps them: 0604 0041h [M5]") {
  for (const std::string reset : {"", "000#8201", "000#8101"}) {
    CAPTURE(reset);
    PdoNode node(without_flag_p());
    if (!reset.empty()) {
      node.rx(reset);
      node.frames();
    }
    node.start();
    CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
    CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
    CHECK(node.set(0x1600, 0, 1, 0) == 0);
    CHECK(node.set(0x1A00, 0, 1, 0) == 0);
    CHECK(node.set(0x1600, 1, 4, 0x22010108) == 0);
    CHECK(node.set(0x1600, 2, 4, 0x22410108) == abort_not_mappable);
    CHECK(node.set(0x1A00, 1, 4, 0x22420110) == abort_not_mappable);
    CHECK(node.set(0x1A00, 2, 4, 0x22410108) == abort_not_mappable);
    CHECK(node.set(0x1600, 0, 1, 2) == abort_not_mappable);
    CHECK(node.set(0x1A00, 0, 1, 2) == abort_not_mappable);
    CHECK(node.get(0x1600, 0) == 0);
    CHECK(node.get(0x1A00, 0) == 0);
    CHECK(node.set(0x1400, 1, 4, 0x201) == 0x06090030);
    CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0x06090030);
    CHECK(node.set(0x1600, 0, 1, 1) == 0);
    CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
    node.rx("201#C1");
    CHECK(node.u8[0] == 0xC1);
    CHECK(node.n8 == 0x11);
  }
}

TEST_CASE("PDO static: sub 0 accepts the number of the table; another number needs objects with flag P [M1]") {
  PdoNode node(without_flag_p());
  node.start();
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1A00, 0, 1, 2) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  node.trigger(0);
  node.tx("181#111211");
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1A00, 0, 1, 1) == abort_not_mappable);
  CHECK(node.get(0x1A00, 0) == 0);
}

TEST_CASE("PDO static: access rights and lengths of objects without flag P are checked [M9]") {
  for (const std::uint32_t word : {0x22410110U, 0x22410104U, 0x22410208U, 0x30000108U}) {
    CAPTURE(word);
    CHECK(Static({{0x1600, 1, {word}}, right_tpdo}).error() == CO_ERR_RPDO_MAP_OBJ);
    CHECK(Static({right_rpdo, {0x1A00, 1, {word}}}).error() == CO_ERR_TPDO_MAP_OBJ);
  }
  std::uint8_t byte = 0x42;
  const auto error_with = [&](std::uint32_t flags, const Constant& mapping) {
    PdoTable table;
    table.rpdo[0].on(mapping.index == 0x1600 ? 0x201 : 0x80000201, 255, {0x22010108});
    table.tpdo[0].on(mapping.index == 0x1A00 ? 0x40000181 : 0xC0000181, 254, {0x22010108});
    PdoNode node(table, [&](Setup& setup) {
      setup.with({CO_KEY(0x2100, 0, flags), CO_TUNSIGNED8, &byte});
      mapping.add_to(setup);
    });
    return node.error();
  };
  CHECK(error_with(CO_OBJ_____R_, {0x1600, 1, {0x21000008}}) == CO_ERR_RPDO_MAP_OBJ);
  CHECK(error_with(CO_OBJ______W, {0x1600, 1, {0x21000008}}) == CO_ERR_NONE);
  CHECK(error_with(CO_OBJ______W, {0x1A00, 1, {0x21000008}}) == CO_ERR_TPDO_MAP_OBJ);
  CHECK(error_with(CO_OBJ_____R_, {0x1A00, 1, {0x21000008}}) == CO_ERR_NONE);
}

TEST_CASE("PDO static: a change of an object without flag P triggers the TPDOs that map it") {
  PdoNode node(without_flag_p());
  node.start();
  node.call([&] { COTPdoTrigObj(node->TPdo, node.find(0x2241, 1)); });
  node.tx("181#111211");
  CHECK(node.error() == CO_ERR_NONE);
  node.find(0x2241, 1)->Key |= CO_OBJ___A___;
  CHECK(node.set(0x2241, 1, 1, 0x77) == 0);
  node.tx("181#111277");
}

TEST_CASE("PDO static: dummies may be mapped in the table like by SDO [M8]") {
  Static node(
      {{0x1600, 8, {0x00020008, 0x00050008, 0x00020008, 0x00050008, 0x00020008, 0x00050008, 0x00020008, 0x22010108}}});
  CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);  // TPDO 0 has no mapping
  node.check_others();
  node.rx("201#A1A2A3A4A5A6A7A8");
  CHECK(node.u8[0] == 0xA8);
}

TEST_CASE("PDO static: a fault at start is detected again after a reset communication [M9]") {
  Static node({right_rpdo, {0x1A00, 1, {0x22020108}}});
  CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);
  CHECK(node.error() == CO_ERR_NONE);
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.error() == CO_ERR_TPDO_MAP_OBJ);
  node.check_others();
  node.check_no_tpdo();
}

TEST_CASE("PDO static: a PDO with a wrong mapping cannot be switched on by SDO: 0609 0030h [M9] [P6]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22020108});
  table.tpdo[0].on(0x40000181, 254, {0x22020108});
  PdoNode node(table);
  node.start();
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0x06090030);
  CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0x06090030);
  node.rx("201#A1");
  CHECK(node.u16[0] == 0x1211);
  node.trigger(0);
  node.silent();
}

TEST_CASE("PDO static: the re-mapping procedure repairs a mapping that was wrong at start [M1] [M9]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22020108});
  table.tpdo[0].on(0x40000181, 254, {0x22020108});
  PdoNode node(table);
  node.start();
  REQUIRE(node.remap_rpdo(0, {0x22020110}, 0x201) == 0);
  REQUIRE(node.remap_tpdo(0, {0x22020210}, 0x40000181) == 0);
  node.rx("201#A1A2");
  CHECK(node.u16[0] == 0xA2A1);
  node.trigger(0);
  node.tx("181#2122");
}

TEST_CASE("PDO static: entries may have basic types") {
  PdoNode node({}, [](Setup& setup) {
    setup.with({CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x201});
    setup.with({CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, 255});
    setup.with({CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 2});
    setup.with({CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x22010108});
    setup.with({CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x22020110});
  });
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  node.rx("201#A1A2A3");
  CHECK(node.u8[0] == 0xA1);
  CHECK(node.u16[0] == 0xA3A2);
}

#if CO_RPDO_N >= 1 && CO_TPDO_N >= 1

std::uint8_t speed = 0x11;
std::uint16_t torque = 0x2221;

/// A dictionary in read-only memory that is checked at compile time.
constexpr CO_OBJ read_only[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, &speed},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 1},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 5},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, CO_COBID_RPDO_DEFAULT(0)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, 255},
    {CO_KEY(0x1400, 3, CO_OBJ_D___R_), CO_TPDO_INHIBIT, 0},
    {CO_KEY(0x1400, 5, CO_OBJ_D___R_), CO_TPDO_EVENT, 0},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, 1},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, CO_LINK(0x2002, 0, 16)},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 6},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, CO_COBID_TPDO_DEFAULT(0)},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, 254},
    {CO_KEY(0x1800, 3, CO_OBJ_D___R_), CO_TPDO_INHIBIT, 0},
    {CO_KEY(0x1800, 5, CO_OBJ_D___R_), CO_TPDO_EVENT, 0},
    {CO_KEY(0x1800, 6, CO_OBJ_D___R_), CO_TPDO_START, 0},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, 2},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, CO_LINK(0x2002, 0, 16)},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, CO_LINK(0x2001, 0, 8)},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, &speed},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED16, &torque},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(read_only);

TEST_CASE("PDO static: a constexpr table with PDOs passes CO_OD_CHECK() and works [M9]") {
  PdoNode node({}, [](Setup& setup) {
    for (const CO_OBJ& entry : read_only) {
      if (entry.Key != 0 && CO_GET_IDX(entry.Key) >= 0x1400) {
        setup.with(entry);
      }
    }
  });
  node.may_change(0x2001, 0);
  node.may_change(0x2002, 0);
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  node.trigger(0);
  node.tx("181#212211");
  node.rx("201#3344");
  node.trigger(0);
  node.tx("181#334411");
  torque = 0x2221;
}

#endif

}  // namespace
