// SPDX-License-Identifier: Apache-2.0
// 1600h… and 1A00h…, sub-index 0 (number of mapped objects), dummies, and single bits. [301:7.5.2.36, 7.5.2.38]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

constexpr std::uint32_t abort_no_object = 0x06020000;
constexpr std::uint32_t abort_not_mappable = 0x06040041;
constexpr std::uint32_t abort_too_long = 0x06040042;

// Sub 0 ---------------------------------------------------------------------------------------------------------------

PdoTable eight_bytes() {
  PdoTable table;
  for (PdoEntries* pdo : {&table.rpdo[0], &table.tpdo[0]}) {
    for (std::uint32_t s = 1; s <= 8; ++s) {
      pdo->map[s - 1] = 0x22010008U | s << 8;
    }
  }
  return table;
}

#if !USE_PDO_BITS

TEST_CASE("PDO mapping: a number above the possible one is refused with 0604 0042h and sets 0 [M6] [PDO 25]") {
  PdoNode node(eight_bytes());
  node.ask("601#2F001600FD000000", "581#8000160042000406");
  for (unsigned number = 9; number <= 0xFD; ++number) {
    CAPTURE(number);
    CHECK(node.set(0x1600, 0, 1, 8) == 0);
    CHECK(node.set(0x1600, 0, 1, number) == abort_too_long);
    CHECK(node.get(0x1600, 0) == 0);
    CHECK(node.set(0x1A00, 0, 1, 8) == 0);
    CHECK(node.set(0x1A00, 0, 1, number) == abort_too_long);
    CHECK(node.get(0x1A00, 0) == 0);
  }
}

#endif

#if CO_MPDO_N == 0

TEST_CASE("PDO mapping: FEh and FFh (MPDO) are refused with 0604 0042h by a node without MPDOs [M7]") {
  PdoNode node(eight_bytes());
  node.ask("601#2F001600FE000000", "581#8000160042000406");
  node.ask("601#2F001600FF000000", "581#8000160042000406");
  node.ask("601#2F001A00FE000000", "581#80001A0042000406");
  node.ask("601#2F001A00FF000000", "581#80001A0042000406");
}

#endif

TEST_CASE("PDO mapping: more than 64 bits are refused with 0604 0042h and set 0 [M6] [PDO 26]") {
  struct Sum {
    std::vector<std::uint32_t> words;
    unsigned fitting;
  };
  const Sum sums[] = {
      {{0x22080140, 0x22010108}, 1},
      {{0x22010108, 0x22080140}, 1},
      {{0x22080140, 0x22080240}, 1},
      {{0x22040120, 0x22040220, 0x22010108}, 2},
      {{0x22070138, 0x22010108, 0x22010208}, 2},
      {{0x22070138, 0x22020110}, 1},
      {{0x22020110, 0x22020210, 0x22020310, 0x22020410, 0x22010108}, 4},
      {{0x22080140, 0x22080240, 0x22080340, 0x22080440, 0x22080540, 0x22080640, 0x22080740, 0x22080840}, 1},
  };
  for (const Sum& one : sums) {
    CAPTURE(one.words.size());
    PdoNode node;
    for (std::uint8_t s = 0; s < one.words.size(); ++s) {
      CHECK(node.set(0x1600, static_cast<std::uint8_t>(s + 1), 4, one.words[s]) == 0);
      CHECK(node.set(0x1A00, static_cast<std::uint8_t>(s + 1), 4, one.words[s]) == 0);
    }
    for (unsigned number = static_cast<unsigned>(one.words.size()); number > 0; --number) {
      const bool fits = number <= one.fitting;
      CHECK(node.set(0x1600, 0, 1, number) == (fits ? 0 : abort_too_long));
      CHECK(node.get(0x1600, 0) == (fits ? number : 0));
      CHECK(node.set(0x1A00, 0, 1, number) == (fits ? 0 : abort_too_long));
      CHECK(node.get(0x1A00, 0) == (fits ? number : 0));
    }
  }
}

TEST_CASE("PDO mapping: a number that includes an empty entry is refused with 0604 0042h and sets 0 [M6]") {
  PdoTable table = eight_bytes();
  table.rpdo[0].map[2] = table.tpdo[0].map[0] = 0;
  PdoNode node(table);
  CHECK(node.set(0x1600, 0, 1, 2) == 0);
  CHECK(node.set(0x1600, 0, 1, 3) == abort_too_long);
  CHECK(node.get(0x1600, 0) == 0);
  CHECK(node.set(0x1600, 0, 1, 8) == abort_too_long);
  for (unsigned number = 1; number <= 8; ++number) {
    CHECK(node.set(0x1A00, 0, 1, number) == abort_too_long);
  }
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0x06090030);
  CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0x06090030);
}

TEST_CASE("PDO mapping: a number that includes a missing entry is refused and sets 0 [M6]") {
  PdoNode node(eight_bytes(), [](Setup& setup) {
    for (std::uint8_t sub = 5; sub <= CO_PDO_MAP_N; ++sub) {
      setup.without(0x1600, sub).without(0x1A00, sub);
    }
  });
  for (const std::uint16_t index : {std::uint16_t{0x1600}, std::uint16_t{0x1A00}}) {
    CHECK(node.set(index, 0, 1, 4) == 0);
    const std::uint32_t abort = node.set(index, 0, 1, 5);
    CHECK((abort == abort_too_long || abort == abort_not_mappable));
    CHECK(node.get(index, 0) == 0);
    CHECK(node.set(index, 5, 4, 0x22010108) == 0x06090011);
  }
}

TEST_CASE("PDO mapping: sub 0 checks every entry again: 0604 0041h sets 0 [M6]") {
  PdoTable table = eight_bytes();
  PdoNode node(table);
  struct Wrong {
    std::uint32_t rpdo;
    std::uint32_t tpdo;
  };
  const Wrong words[] = {{0x22410108, 0x22410108}, {0x22210108, 0x22310108}, {0x22010110, 0x22010110},
                         {0x22010900, 0x22010900}, {0x30000108, 0x30000108}, {0x22010100, 0x22010100},
                         {0x00020010, 0x00020008}};
  for (const Wrong& one : words) {
    CAPTURE(one.rpdo);
    for (unsigned place = 0; place < 8; ++place) {
      node.rpdo[0] = table.rpdo[0];
      node.tpdo[0] = table.tpdo[0];
      node.rpdo[0].map[place] = one.rpdo;  // a write by the application is not checked
      node.tpdo[0].map[place] = one.tpdo;
      CHECK(node.set(0x1600, 0, 1, place) == 0);
      CHECK(node.set(0x1600, 0, 1, place + 1) == abort_not_mappable);
      CHECK(node.get(0x1600, 0) == 0);
      CHECK(node.set(0x1A00, 0, 1, place) == 0);
      CHECK(node.set(0x1A00, 0, 1, place + 1) == abort_not_mappable);
      CHECK(node.get(0x1A00, 0) == 0);
    }
  }
}

TEST_CASE("PDO mapping: an object that has lost its access rights is refused when sub 0 is written [M6]") {
  PdoNode node(eight_bytes());
  CHECK(node.set(0x1600, 0, 1, 8) == 0);
  CHECK(node.set(0x1600, 0, 1, 0) == 0);
  CO_OBJ* const third = node.find(0x2201, 3);
  REQUIRE(third != nullptr);
  third->Key &= ~std::uint32_t{CO_OBJ______W};
  CHECK(node.set(0x1600, 0, 1, 8) == abort_not_mappable);
  CHECK(node.set(0x1A00, 0, 1, 8) == 0);
  CHECK(node.set(0x1A00, 0, 1, 0) == 0);
  third->Key &= ~std::uint32_t{CO_OBJ____P__};
  CHECK(node.set(0x1A00, 0, 1, 8) == abort_not_mappable);
  CHECK(node.set(0x1A00, 0, 1, 2) == 0);
}

// Dummies -------------------------------------------------------------------------------------------------------------

std::uint32_t rpdo_word(PdoNode& node, std::uint32_t word) { return node.set(0x1600, 1, 4, word); }
std::uint32_t tpdo_word(PdoNode& node, std::uint32_t word) { return node.set(0x1A00, 1, 4, word); }

constexpr std::uint32_t dummies[] = {0x00020008, 0x00030010, 0x00040020, 0x00050008, 0x00060010, 0x00070020};

TEST_CASE("PDO mapping: 0002h to 0007h can be mapped into RPDOs without entries of the dictionary [M8] [PDO 33]") {
  PdoNode node;
  REQUIRE(node.find(0x0002, 0) == nullptr);
  node.start();
  for (const std::uint32_t dummy : dummies) {
    CAPTURE(dummy);
    REQUIRE(node.remap_rpdo(0, {dummy, 0x22010108}, 0x201) == 0);
    node.u8[0] = 0;
    switch (dummy & 0xFF) {
      case 8: node.rx("201#A1C5"); break;
      case 16: node.rx("201#A1A2C5"); break;
      default: node.rx("201#A1A2A3A4C5"); break;
    }
    CHECK(node.u8[0] == 0xC5);
  }
}

TEST_CASE("PDO mapping: a dummy cannot be mapped into a TPDO: 0604 0041h [M8]") {
  PdoNode node;
  node.ask("601#23001A0108000200", "581#80001A0141000406");
  for (const std::uint32_t dummy : dummies) {
    CAPTURE(dummy);
    CHECK(tpdo_word(node, dummy) == abort_not_mappable);
  }
  CHECK(tpdo_word(node, 0x00010001) == abort_not_mappable);
}

TEST_CASE("PDO mapping: a dummy with another length or sub-index than 0 is refused with 0604 0041h [M8]") {
  PdoNode node;
  constexpr unsigned lengths[] = {USE_PDO_BITS ? 1U : 256U, 8, 16, 32, 8, 16, 32};
  for (unsigned index = 1; index <= 7; ++index) {
    for (unsigned bits = 0; bits <= 255; ++bits) {
      CAPTURE(index);
      CAPTURE(bits);
      CHECK(rpdo_word(node, index << 16 | bits) == (bits == lengths[index - 1] ? 0 : abort_not_mappable));
    }
    for (const unsigned sub : {1U, 2U, 255U}) {
      const std::uint32_t abort = rpdo_word(node, index << 16 | sub << 8 | (lengths[index - 1] & 0xFFU));
      CHECK((abort == abort_not_mappable || abort == abort_no_object));
    }
  }
}

TEST_CASE("PDO mapping: dummies occupy their lengths in the frame [M8]") {
  PdoNode node;
  node.start();
  REQUIRE(node.remap_rpdo(
              0, {0x00050008, 0x00050008, 0x00050008, 0x00050008, 0x00050008, 0x00050008, 0x00050008, 0x22010108},
              0x201) == 0);
  node.rx("201#A1A2A3A4A5A6A7A8");
  CHECK(node.u8[0] == 0xA8);
  REQUIRE(node.remap_rpdo(0, {0x00070020, 0x00070020}, 0x201) == 0);
  node.rx("201#A1A2A3A4A5A6A7A8");
  CHECK(node.u8[0] == 0xA8);
  REQUIRE(node.remap_rpdo(0, {0x00070020, 0x22010108, 0x00060010, 0x22010208}, 0x201) == 0);
  node.rx("201#B1B2B3B4B5B6B7B8");
  CHECK(node.u8[0] == 0xB5);
  CHECK(node.u8[1] == 0xB8);
  CHECK(node.u8[2] == 0x31);
}

TEST_CASE("PDO mapping: the bits of dummies are included in the sum [M6] [M8]") {
  PdoTable table;
  table.rpdo[0].map = {0x00070020, 0x00040020, 0x00020008};
  PdoNode node(table);
  CHECK(node.set(0x1600, 0, 1, 3) == abort_too_long);
  CHECK(node.set(0x1600, 0, 1, 2) == 0);
  CHECK(node.set(0x1400, 1, 4, 0x201) == 0);
}

TEST_CASE("PDO mapping: entries of static data types in the dictionary change nothing [M8]") {
  PdoNode node({}, [](Setup& setup) {
    setup.with({CO_KEY(0x0002, 0, CO_OBJ_____RW), CO_TUNSIGNED8, 0});
    setup.with({CO_KEY(0x0007, 0, CO_OBJ____PRW), CO_TUNSIGNED32, 0});
  });
  CHECK(rpdo_word(node, 0x00020008) == 0);
  CHECK(rpdo_word(node, 0x00070020) == 0);
  CHECK(rpdo_word(node, 0x00070008) == abort_not_mappable);
  CHECK(tpdo_word(node, 0x00070020) == abort_not_mappable);
  node.start();
  REQUIRE(node.remap_rpdo(0, {0x00020008, 0x22010108, 0x00070020}, 0x201) == 0);
  node.rx("201#A1A2A3A4A5A6");
  CHECK(node.u8[0] == 0xA2);
}

// Bits ----------------------------------------------------------------------------------------------------------------

#if USE_PDO_BITS

TEST_CASE("PDO mapping: BOOLEAN occupies one bit, beginning with bit 0 of byte 0 [M10]") {
  PdoNode node;
  node.start();
  REQUIRE(node.remap_tpdo(0, {0x22500101, 0x22500201, 0x22500301, 0x22010108}, 0x40000181) == 0);
  node.boolean[0] = 1;
  node.boolean[2] = 1;
  node.u8[0] = 0xFF;
  node.trigger(0);
  node.tx("181#FD07");
  node.boolean[0] = node.boolean[2] = 0;
  node.boolean[1] = 1;
  node.u8[0] = 0;
  node.trigger(0);
  node.tx("181#0200");
  REQUIRE(node.remap_rpdo(0, {0x22500101, 0x00010001, 0x22500301, 0x22020110}, 0x201) == 0);
  node.rx("201#4A5A01");
  CHECK(node.boolean[0] == 0);
  CHECK(node.boolean[1] == 1);
  CHECK(node.boolean[2] == 0);
  CHECK(node.u16[0] == (0x015A4A >> 3 & 0xFFFF));
  node.rx("201#FDFF07");
  CHECK(node.boolean[0] == 1);
  CHECK(node.boolean[1] == 1);
  CHECK(node.boolean[2] == 1);
  CHECK(node.u16[0] == 0xFFFF);
}

TEST_CASE("PDO mapping: 64 single bits fit into a PDO, 65 do not [M6] [M10]") {
  std::vector<std::uint32_t> words(64, 0x00010001);
  words[0] = 0x22500101;
  words[63] = 0x22500201;
  PdoNode node;
  node.start();
  REQUIRE(node.remap_rpdo(0, words, 0x201) == 0);
  node.rx("201#FEFFFFFFFFFFFF7F");
  CHECK(node.boolean[0] == 0);
  CHECK(node.boolean[1] == 0);
  node.rx("201#0100000000000080");
  CHECK(node.boolean[0] == 1);
  CHECK(node.boolean[1] == 1);
  words[10] = 0x22010108;
  CHECK(node.remap_rpdo(0, words, 0x201) == abort_too_long);
}

TEST_CASE("PDO mapping: the length of a frame is rounded up to bytes [M10]") {
  PdoNode node;
  node.start();
  node.boolean[0] = 1;
  for (unsigned bits = 1; bits <= 64; ++bits) {
    CAPTURE(bits);
    REQUIRE(node.remap_tpdo(0, std::vector<std::uint32_t>(bits, 0x22500101), 0x40000181) == 0);
    node.trigger(0);
    REQUIRE(node.can.sent.size() == 1);
    CHECK(node.can.sent[0].frm.DLC == (bits + 7) / 8);
    node.frames();
  }
}

#else

TEST_CASE("PDO mapping: without mapping of single bits 0001h is no dummy and BOOLEAN occupies a byte [M5] [M8]") {
  PdoNode node;
  CHECK(rpdo_word(node, 0x00010001) == abort_not_mappable);
  CHECK(rpdo_word(node, 0x00010008) == abort_not_mappable);
  CHECK(rpdo_word(node, 0x22500101) == abort_not_mappable);
  CHECK(tpdo_word(node, 0x22500101) == abort_not_mappable);
  CHECK(rpdo_word(node, 0x22500108) == 0);
  CHECK(tpdo_word(node, 0x22500108) == 0);
}

#endif

}  // namespace
