// SPDX-License-Identifier: Apache-2.0
// 1301h…, 1381h…, 13FEh, 13FFh, and their check when Operational is entered. [EN 50325-5]
#include "lexican/srdo.hpp"
#include "support/srdo_fixture.hpp"

#if CO_SRDO_N > 1

namespace {

using namespace test;

constexpr std::uint32_t refused_in_state = 0x08000022;
constexpr std::uint32_t wrong_value = 0x06090030;
constexpr std::uint32_t wrong_number = 0x06040042;
constexpr std::uint32_t not_mappable = 0x06040041;
constexpr std::uint32_t unsupported = 0x06010000;

SrdoTable receiver() {
  SrdoTable table;
  table.srdo[0].receive(0x109, pair_of_3);
  return table;
}

// --- Writes

TEST_CASE("1301h:1: 0 to 2 are accepted [SR1]") {
  SrdoNode node;
  for (unsigned value = 0; value < 256; ++value) {
    CAPTURE(value);
    CHECK(node.set(0x1301, 1, 1, value) == (value > 2 ? wrong_value : 0));
    CHECK(node.srdo[0].direction == (value > 2 ? 2 : value));
  }
  node.trace();
}

TEST_CASE("1301h:2 and 1301h:3: times of 0 are refused [SR1]") {
  SrdoNode node;
  CHECK(node.set(0x1301, 2, 2, 0) == wrong_value);
  for (const std::uint32_t value : {1U, 2U, 0x00FFU, 0x0100U, 0x8000U, 0xFFFFU}) {
    CHECK(node.set(0x1301, 2, 2, value) == 0);
    CHECK(node.srdo[0].cycle == value);
  }
  for (unsigned value = 0; value < 256; ++value) {
    CHECK(node.set(0x1301, 3, 1, value) == (value == 0 ? wrong_value : 0));
  }
  CHECK(node.srdo[0].validation == 255);
  node.trace();
}

TEST_CASE("1301h:4: only transmission type 254 is accepted [SR1]") {
  SrdoNode node;
  for (unsigned value = 0; value < 256; ++value) {
    CHECK(node.set(0x1301, 4, 1, value) == (value == 254 ? 0 : wrong_value));
  }
  CHECK(node.srdo[0].type == 254);
  node.trace();
}

TEST_CASE("1301h:5 and 1301h:6: odd COB-IDs 101h to 17Fh and even ones 102h to 180h are accepted [SR1]") {
  SrdoNode node;
  for (std::uint32_t value = 0; value < 0x900; ++value) {
    CAPTURE(value);
    CHECK(node.set(0x1301, 5, 4, value) == (value >= 0x101 && value <= 0x17F && value % 2 == 1 ? 0 : wrong_value));
    CHECK(node.set(0x1301, 6, 4, value) == (value >= 0x102 && value <= 0x180 && value % 2 == 0 ? 0 : wrong_value));
  }
  for (const std::uint32_t flag : {0x80000000U, 0x40000000U, 0x20000000U}) {
    CHECK(node.set(0x1301, 5, 4, flag | 0x101) == wrong_value);
    CHECK(node.set(0x1301, 6, 4, flag | 0x102) == wrong_value);
  }
  CHECK(node.srdo[0].plain_id == 0x17F);
  CHECK(node.srdo[0].inverse_id == 0x180);
  node.trace();
}

TEST_CASE("1381h:0: even numbers up to 16 are accepted while the direction is 0 [SR2]") {
  SrdoNode node;
  for (unsigned value = 0; value < 256; ++value) {
    CAPTURE(value);
    CHECK(node.set(0x1381, 0, 1, value) == (value % 2 == 0 && value <= 16 ? 0 : wrong_number));
  }
  CHECK(node.srdo[0].number == 16);
  for (const unsigned direction : {1U, 2U}) {
    CHECK(node.set(0x1301, 1, 1, direction) == 0);
    CHECK(node.set(0x1381, 0, 1, 0) == unsupported);
    CHECK(node.set(0x1381, 0, 1, 3) == unsupported);
  }
  CHECK(node.srdo[0].number == 16);
  node.trace();
}

TEST_CASE("1381h:1 to 16: entries are accepted while direction and number are 0 [SR2]") {
  SrdoNode node;
  for (std::uint8_t sub = 1; sub <= 16; ++sub) {
    CHECK(node.set(0x1381, sub, 4, 0x23000108) == 0);
    CHECK(node.srdo[0].map[sub - 1U] == 0x23000108);
  }
  CHECK(node.set(0x1381, 0, 1, 2) == 0);
  CHECK(node.set(0x1381, 1, 4, 0x23000208) == unsupported);
  CHECK(node.set(0x1381, 0, 1, 0) == 0);
  CHECK(node.set(0x1301, 1, 1, 2) == 0);
  CHECK(node.set(0x1381, 1, 4, 0x23000208) == unsupported);
  CHECK(node.srdo[0].map[0] == 0x23000108);
  node.trace();
}

TEST_CASE("1381h: entries with a wrong length, object or flag are refused [SR2]") {
  SrdoNode node;
  const std::pair<std::uint32_t, std::uint32_t> cases[] = {{0x23000100, wrong_value},
                                                           {0x23000101, wrong_value},
                                                           {0x23000107, wrong_value},
                                                           {0x23000109, wrong_value},
                                                           {0x23000148, wrong_value},
                                                           {0x230001F8, wrong_value},
                                                           {0x23000110, not_mappable},
                                                           {0x23020108, not_mappable},
                                                           {0x230A0108, not_mappable},
                                                           {0x23FF0108, 0x06020000},
                                                           {0x23000908, 0x06020000},
                                                           {0x00010001, wrong_value},
                                                           {0x00050010, 0x06020000},
                                                           {0x00050108, 0x06020000},
                                                           {0x00080020, 0x06020000},
                                                           {0x00000008, 0x06020000},
                                                           {0x00000000, 0},
                                                           {0x23080108, 0},
                                                           {0x23090108, 0},
                                                           {0x23060140, 0},
                                                           {0x00020008, 0},
                                                           {0x00030010, 0},
                                                           {0x00040020, 0},
                                                           {0x00050008, 0},
                                                           {0x00060010, 0},
                                                           {0x00070020, 0}};
  for (const auto& row : cases) {
    CAPTURE(row.first);
    CHECK(node.set(0x1381, 1, 4, row.first) == row.second);
  }
  node.trace();
}

TEST_CASE("SRDO objects: in Operational every write is refused and every read answered [SR3]") {
  SrdoNode node(receiver());
  node.start();
  for (std::uint8_t sub = 1; sub <= 6; ++sub) {
    const unsigned bytes = sub == 2 ? 2 : sub < 5 ? 1 : 4;
    CHECK(node.set(0x1301, sub, bytes, 1) == refused_in_state);
    CHECK(node.set(0x1302, sub, bytes, 0) == refused_in_state);
    CHECK(node.upload(0x1301, sub).size() == bytes);
  }
  for (std::uint8_t sub = 0; sub <= 16; ++sub) {
    CHECK(node.set(0x1381, sub, sub == 0 ? 1 : 4, 0) == refused_in_state);
    CHECK(node.set(0x1382, sub, sub == 0 ? 1 : 4, 0) == refused_in_state);
  }
  CHECK(node.set(0x13FE, 0, 1, 0xA5) == refused_in_state);
  CHECK(node.set(0x13FE, 0, 1, 0) == refused_in_state);
  CHECK(node.set(0x13FF, 1, 2, 0) == refused_in_state);
  CHECK(node.upload(0x13FE, 0) == Bytes{0xA5});
  CHECK(node.upload(0x13FF, 1) == Bytes{0x8B, 0xB7});
  CHECK(node.state() == CO_SRDO_INITIALISING);
  node.trace();
}

TEST_CASE("13FEh: each accepted write of another object sets it to 0; a refused one does not [SR4]") {
  SrdoNode node;
  const struct {
    std::uint16_t index;
    std::uint8_t sub;
    unsigned bytes;
    std::uint32_t value;
    bool accepted;
  } cases[] = {{0x1301, 1, 1, 0, true},   {0x1301, 2, 2, 25, true},    {0x1301, 3, 1, 20, true},
               {0x1301, 4, 1, 254, true}, {0x1301, 5, 4, 0x101, true}, {0x1301, 6, 4, 0x102, true},
               {0x1302, 1, 1, 0, true},   {0x1381, 1, 4, 0, true},     {0x1382, 16, 4, 0, true},
               {0x1381, 0, 1, 0, true},   {0x13FF, 1, 2, 0, true},     {0x13FF, 2, 2, 0x1234, true},
               {0x1301, 1, 1, 3, false},  {0x1301, 2, 2, 0, false},    {0x1301, 5, 4, 0x102, false},
               {0x1381, 0, 1, 1, false},  {0x1381, 1, 4, 1, false},    {0x1017, 0, 2, 0, true}};
  for (const auto& one : cases) {
    CAPTURE(one.index);
    CAPTURE(one.sub);
    CHECK(node.set(0x13FE, 0, 1, 0xA5) == 0);
    CHECK((node.set(one.index, one.sub, one.bytes, one.value) == 0) == one.accepted);
    CHECK(node.valid == (one.accepted && one.index != 0x1017 ? 0 : 0xA5));
  }
  node.trace();
}

TEST_CASE("13FEh: every value can be written and only A5h is valid [SR4]") {
  SrdoNode node(receiver());
  for (unsigned value = 0; value < 256; ++value) {
    CHECK(node.set(0x13FE, 0, 1, value) == 0);
    CHECK(node.valid == value);
    node.start();
    CHECK(node.state() == (value == 0xA5 ? CO_SRDO_INITIALISING : CO_SRDO_ERR_CONFIGURATION));
    node.rx("000#8001");
    node.silent();
  }
}

TEST_CASE("SRDO objects: writes of a wrong length are refused and change nothing [SR1]") {
  SrdoNode node;
  const std::pair<std::uint16_t, std::uint8_t> objects[] = {{0x1301, 1}, {0x1301, 2}, {0x1301, 3}, {0x1301, 4},
                                                            {0x1301, 5}, {0x1301, 6}, {0x1381, 0}, {0x1381, 1},
                                                            {0x13FE, 0}, {0x13FF, 1}};
  for (const auto& [index, sub] : objects) {
    const std::size_t right = node.upload(index, sub).size();
    for (std::size_t length = 1; length <= 8; ++length) {
      if (length == right) continue;
      const std::uint32_t abort = node.download(index, sub, Bytes(length, 0));
      CHECK(abort == (length > right ? 0x06070012 : 0x06070013));
    }
  }
  CHECK(node.valid == 0xA5);
  node.trace();
}

TEST_CASE("SRDO objects: the application is refused in Operational like the network [SR3]") {
  SrdoNode node(receiver());
  node.call([&] { CHECK(CODictWrByte(&node.node.Dict, CO_DEV(0x1301, 3), 30) == CO_ERR_NONE); });
  CHECK(node.valid == 0);
  node.call([&] { CHECK(CODictWrByte(&node.node.Dict, CO_DEV(0x13FE, 0), 0xA5) == CO_ERR_NONE); });
  node.rx("000#0101");
  node.trace();
  node.call([&] { CHECK(CODictWrByte(&node.node.Dict, CO_DEV(0x1301, 3), 20) == CO_ERR_OBJ_STATE); });
  node.call([&] { CHECK(CODictWrByte(&node.node.Dict, CO_DEV(0x13FE, 0), 0) == CO_ERR_OBJ_STATE); });
}

// --- Signature

TEST_CASE("SRDO signature: CRC of the parameters in their order [SR5]") {
  SrdoNode node(receiver());
  std::uint16_t signature = 0;
  CHECK(COSrdoSignature(&node.node, 0, &signature) == CO_ERR_NONE);
  CHECK(signature == 0xB78B);
  node.srdo[0].number = 0;
  CHECK(COSrdoSignature(&node.node, 0, &signature) == CO_ERR_NONE);
  CHECK(signature == 0x596A);
  node.srdo[0].number = 17;
  CHECK(COSrdoSignature(&node.node, 0, &signature) == CO_ERR_OBJ_MAP_LEN);
  CHECK(COSrdoSignature(&node.node, CO_SRDO_N, &signature) == CO_ERR_BAD_ARG);
  CHECK(COSrdoSignature(nullptr, 0, &signature) == CO_ERR_BAD_ARG);
  CHECK(COSrdoSignature(&node.node, 0, nullptr) == CO_ERR_BAD_ARG);
  Fixture none(Setup().only_small());
  CHECK(COSrdoSignature(&none.node, 0, &signature) == CO_ERR_OBJ_NOT_FOUND);
}

TEST_CASE("SRDO signature: the compiler computes the value of the node [SR5]") {
  static constexpr std::uint32_t mapping[] = {0x23000108, 0x23010108, 0x23020110, 0x23030110};
  static_assert(co::srdo::signature({2, 50, 20, 0x109, 0x10A}, mapping) == 0xB78B);
  static constexpr std::uint32_t other[] = {0x20000108, 0x20000208};
  static_assert(co::srdo::signature({1, 25, 20, 0x101, 0x102}, other) == 0x51AF);
}

// --- Check when Operational is entered

TEST_CASE("SRDO check: each change of one bit of the configuration is found by the signature [SR6]") {
  const SrdoTable right = receiver();
  const auto is_found = [&](const std::function<void(SrdoNode&)>& change) {
    SrdoNode node(right);
    change(node);
    node.rx("000#0101");
    const bool found = node.state() == CO_SRDO_ERR_CONFIGURATION && node.valid == 0;
    node.trace();
    return found;
  };
  unsigned missed = 0;
  for (unsigned bit = 0; bit < 8; ++bit) {
    missed += is_found([&](SrdoNode& n) { n.srdo[0].validation ^= static_cast<std::uint8_t>(1U << bit); }) ? 0U : 1U;
  }
  for (unsigned bit = 0; bit < 16; ++bit) {
    missed += is_found([&](SrdoNode& n) { n.srdo[0].cycle ^= static_cast<std::uint16_t>(1U << bit); }) ? 0U : 1U;
    missed += is_found([&](SrdoNode& n) { n.srdo[0].signature ^= static_cast<std::uint16_t>(1U << bit); }) ? 0U : 1U;
  }
  for (unsigned bit = 0; bit < 32; ++bit) {
    for (unsigned place = 0; place < 4; ++place) {
      missed += is_found([&](SrdoNode& n) { n.srdo[0].map[place] ^= 1U << bit; }) ? 0U : 1U;
    }
    missed += is_found([&](SrdoNode& n) { n.srdo[0].plain_id ^= 1U << bit; }) ? 0U : 1U;
    missed += is_found([&](SrdoNode& n) { n.srdo[0].inverse_id ^= 1U << bit; }) ? 0U : 1U;
  }
  CHECK(missed == 0);
}

// Starts a node with a table whose signature is right, and expects an EMCY with this index and sub-index.
void expect_fault(const SrdoTable& table, std::string_view emcy, Where at = {__builtin_FILE(), __builtin_LINE()}) {
  SrdoNode node(table);
  node.rx("000#0101");
  node.tx(emcy, at);
  CHECK(node.state() == CO_SRDO_ERR_CONFIGURATION);
  CHECK(node.valid == 0);
  CHECK(node.take_changes().front() == SrdoNode::Change{0, CO_SRDO_ERR_CONFIGURATION});
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  node.after(200ms);
  node.silent();
  CHECK(node.u8[0] == 0);
  CHECK(node.objects.error_register == 0x11);
  node.rx("000#8001");
  node.tx("081#0000000000" + std::string("011300"));
  CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.objects.error_register == 0);
  node.start();  // 13FEh is 0 now: no check, no EMCY
  CHECK(node.state() == CO_SRDO_ERR_CONFIGURATION);
}

TEST_CASE("SRDO check: EMCY 6300h names the wrong communication parameter [SR6]") {
  const auto with = [](const std::function<void(SrdoEntries&)>& change) {
    SrdoTable table = receiver();
    change(table.srdo[0]);
    return table;
  };
  expect_fault(with([](SrdoEntries& s) { s.direction = 3; }), "081#0063110000011301");
  expect_fault(with([](SrdoEntries& s) { s.cycle = 0; }), "081#0063110000011302");
  expect_fault(with([](SrdoEntries& s) { s.validation = 0; }), "081#0063110000011303");
  expect_fault(with([](SrdoEntries& s) { s.type = 255; }), "081#0063110000011304");
  expect_fault(with([](SrdoEntries& s) { s.plain_id = 0x10A; }), "081#0063110000011305");
  expect_fault(with([](SrdoEntries& s) { s.inverse_id = 0x10B; }), "081#0063110000011306");
  expect_fault(with([](SrdoEntries& s) { s.inverse_id = 0x10C; }), "081#0063110000011306");
  expect_fault(with([](SrdoEntries& s) { s.inverse_id = 0x108; }), "081#0063110000011306");
}

TEST_CASE("SRDO check: EMCY 6300h names the wrong signature [SR6]") {
  SrdoTable table = receiver();
  table.is_signed = false;
  table.srdo[0].signature = 0xB78A;
  expect_fault(table, "081#0063110000FF1301");
}

TEST_CASE("SRDO check: EMCY 6300h names the wrong mapping entry [SR6]") {
  const auto with = [](const std::vector<std::uint32_t>& words) {
    SrdoTable table;
    table.srdo[0].receive(0x109, words);
    return table;
  };
  expect_fault(with({}), "081#0063110000811300");                                                // nothing
  expect_fault(with({0x23000108}), "081#0063110000811300");                                      // odd
  expect_fault(with({0x23000108, 0}), "081#0063110000811302");                                   // empty entry
  expect_fault(with({0x23000108, 0x23030110}), "081#0063110000811302");                          // other length
  expect_fault(with({0x23080108, 0x23010108}), "081#0063110000811301");                          // read-only
  expect_fault(with({0x23000108, 0x23080108}), "081#0063110000811302");                          // read-only
  expect_fault(with({0x230A0108, 0x23010108}), "081#0063110000811301");                          // without flag P
  expect_fault(with({0x23FF0108, 0x23010108}), "081#0063110000811301");                          // missing
  expect_fault(with({0x23000101, 0x23010108}), "081#0063110000811301");                          // a bit
  expect_fault(with({0x23060140, 0x23070140, 0x23000108, 0x23010108}), "081#0063110000811303");  // nine bytes
}

TEST_CASE("SRDO check: a producer needs objects that can be read and a consumer objects that can be written [SR6]") {
  for (const bool sends : {false, true}) {
    for (const bool readable : {false, true}) {
      SrdoTable table;
      const std::uint32_t object = readable ? 0x23080108 : 0x23090108;
      table.srdo[0].set(sends ? 1 : 2, 0x109, {object, 0x23010108});
      SrdoNode node(table);
      node.rx("000#0101");
      CHECK((node.state() == CO_SRDO_INITIALISING) == (sends == readable));
      node.trace();
    }
  }
}

TEST_CASE("SRDO check: two SRDOs with the same COB-IDs are refused [SR6]") {
  SrdoTable table = receiver();
  table.srdo[1].receive(0x109, pair_of_3);
  SrdoNode node(table);
  node.start({"081#0063110000021305"});
  CHECK(node.state(0) == CO_SRDO_INITIALISING);
  CHECK(node.state(1) == CO_SRDO_ERR_CONFIGURATION);
}

TEST_CASE("SRDO check: a fault of one SRDO leaves the other one running until Operational ends [SR6]") {
  SrdoTable table = receiver();
  table.srdo[1].receive(0x10B, {0x23000208, 0x23020110});
  SrdoNode node(table);
  node.start({"081#0063110000821302"});
  CHECK(node.take_changes() ==
        std::vector<SrdoNode::Change>{{0, CO_SRDO_INITIALISING}, {1, CO_SRDO_ERR_CONFIGURATION}});
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  CHECK(node.state(0) == CO_SRDO_ESTABLISHED);
  CHECK(!COSrdoIsEstablished(&node.node));
  node.trace();
}

TEST_CASE("SRDO check: without 13FEh or 13FFh no SRDO starts [SR6]") {
  SrdoNode no_valid(receiver(), [](Setup& setup) { setup.without(0x13FE, 0); });
  no_valid.start();
  CHECK(no_valid.state() == CO_SRDO_ERR_CONFIGURATION);
  SrdoNode no_signature(receiver(), [](Setup& setup) { setup.without(0x13FF, 1); });
  no_signature.start({"081#0063110000FF1301"});
  CHECK(no_signature.state() == CO_SRDO_ERR_CONFIGURATION);
}

TEST_CASE("SRDO check: a complete configuration over SDO starts the SRDO [SR6]") {
  SrdoTable table;
  table.valid = 0;
  SrdoNode node(table);
  CHECK(node.state() == CO_SRDO_DELETED);
  CHECK(node.set(0x1301, 2, 2, 50) == 0);
  CHECK(node.set(0x1301, 3, 1, 20) == 0);
  CHECK(node.set(0x1301, 5, 4, 0x109) == 0);
  CHECK(node.set(0x1301, 6, 4, 0x10A) == 0);
  for (std::uint8_t n = 0; n < 4; ++n) CHECK(node.set(0x1381, n + 1, 4, pair_of_3[n]) == 0);
  CHECK(node.set(0x1381, 0, 1, 4) == 0);
  CHECK(node.set(0x1301, 1, 1, 2) == 0);
  CHECK(node.state() == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.set(0x13FF, 1, 2, 0xB78B) == 0);
  CHECK(node.set(0x13FE, 0, 1, 0xA5) == 0);
  node.trace();
  node.start();
  CHECK(node.take_changes() == std::vector<SrdoNode::Change>{{0, CO_SRDO_NOT_OPERATIONAL}, {0, CO_SRDO_INITIALISING}});
  node.rx("109#112233");
  node.rx("10A#EEDDCC");
  CHECK(node.u8[0] == 0x11);
  CHECK(node.inverse8[0] == 0xEE);
  CHECK(node.u16[0] == 0x3322);
  CHECK(node.inverse16[0] == 0xCCDD);
}

TEST_CASE("SRDO states: direction 0 is deleted, in each NMT state and over resets [SR7]") {
  SrdoNode node(receiver());
  CHECK(node.state(0) == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.state(1) == CO_SRDO_DELETED);
  CHECK(node.state(CO_SRDO_N) == CO_SRDO_DELETED);
  CHECK(COSrdoGetState(nullptr, 0) == CO_SRDO_DELETED);
  CHECK(!COSrdoIsEstablished(nullptr));
  CHECK(!COSrdoIsEstablished(&node.node));
  CHECK(node.set(0x1301, 1, 1, 0) == 0);
  CHECK(node.state(0) == CO_SRDO_DELETED);
  CHECK(node.set(0x1301, 1, 1, 1) == 0);
  CHECK(node.state(0) == CO_SRDO_NOT_OPERATIONAL);
  CHECK(node.take_changes() == std::vector<SrdoNode::Change>{{0, CO_SRDO_DELETED}, {0, CO_SRDO_NOT_OPERATIONAL}});
  node.trace();
  callbacks().fatal_errors = 0;
}

// Writes 1301h:1 and requests the SRDO in its Init function.
const CO_OBJ_TYPE* switching_type() {
  static const CO_OBJ_TYPE type = {[](CO_OBJ*, CO_NODE*, std::uint32_t) -> std::uint32_t { return 1; },
                                   [](CO_OBJ* obj, CO_NODE* node) {
                                     const auto direction = static_cast<std::uint8_t>(obj->Data);
                                     CHECK(CODictWrByte(&node->Dict, CO_DEV(0x1301, 1), direction) == CO_ERR_NONE);
                                     CHECK(COSrdoRequest(node, 0) == CO_ERR_NMT_MODE);
                                     return CO_ERR_NONE;
                                   },
                                   nullptr, nullptr, nullptr};
  return &type;
}

TEST_CASE("SRDO states: a direction that an Init function writes in CONodeInit() determines the first state [SR7]") {
  for (const std::uint8_t direction : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}}) {
    CAPTURE(unsigned{direction});
    SrdoTable table;
    table.srdo[0].set(direction == 0 ? 2 : 0, 0x109, pair_of_3);
    SrdoNode node(table, [&](Setup& setup) {
      setup.may_change(0x1301, 1).may_change(0x13FE, 0).with(
          {CO_KEY(0x2400, 0, CO_OBJ_____R_), switching_type(), direction});
    });
    CHECK(node.srdo[0].direction == direction);
    CHECK(node.valid == 0);
    CHECK(node.state() == (direction == 0 ? CO_SRDO_DELETED : CO_SRDO_NOT_OPERATIONAL));
  }
}

TEST_CASE("SRDO types: null data is found when the node starts [SR1]") {
  for (const auto& [index, sub, type] :
       {std::tuple<std::uint16_t, std::uint8_t, const CO_OBJ_TYPE*>{0x1301, 1, CO_TSRDO_COM},
        {0x1301, 2, CO_TSRDO_COM},
        {0x1301, 3, CO_TSRDO_COM},
        {0x1301, 4, CO_TSRDO_COM},
        {0x1301, 5, CO_TSRDO_COM},
        {0x1301, 6, CO_TSRDO_COM},
        {0x1381, 0, CO_TSRDO_MAP},
        {0x1381, 1, CO_TSRDO_MAP},
        {0x13FE, 0, CO_TSRDO_VALID},
        {0x13FF, 1, CO_TSRDO_SIGNATURE}}) {
    Fixture node(Setup().only_small().with({CO_KEY(index, sub, CO_OBJ_____RW), type, 0}));
    CHECK(node.upload(index, sub).empty());
    node.rx("000#0101");
    CHECK(node.mode() == CO_OPERATIONAL);
    node.trace();
  }
}

}  // namespace

#endif
