// SPDX-License-Identifier: Apache-2.0
// PDO mapping of single bits: objects at any bit of the frame. [M10] (Only with USE_PDO_BITS.)
#include <random>

#include "support/sync_fixture.hpp"

#if USE_PDO_BITS && CO_TPDO_N > 0 && CO_RPDO_N > 0

namespace {

using namespace test;

// A mapping entry of an object of the fixture, and the object's value on the bus.
struct Mapped {
  std::uint32_t word;
  std::uint32_t value;
  unsigned bits() const { return word & 0xFFU; }
};

std::uint32_t low_bits(std::uint32_t value, unsigned bits) { return bits == 32 ? value : value & ((1U << bits) - 1U); }

// Returns the frame that contains the objects without gaps from bit 0.
CO_IF_FRM packed(std::uint32_t id, const std::vector<Mapped>& objects) {
  std::uint64_t all = 0;
  unsigned position = 0;
  for (const Mapped& object : objects) {
    all |= std::uint64_t{object.value} << position;
    position += object.bits();
  }
  CO_IF_FRM frame{id, {}, static_cast<std::uint8_t>((position + 7) / 8)};
  for (std::uint8_t& byte : frame.Data) {
    byte = static_cast<std::uint8_t>(all);
    all >>= 8;
  }
  return frame;
}

PdoTable mapping(const std::vector<Mapped>& objects) {
  PdoTable table;
  PdoEntries& rpdo = table.rpdo[0].on(0x201, 255, {});
  PdoEntries& tpdo = table.tpdo[0].on(0x40000181, 255, {});
  for (const Mapped& object : objects) {
    rpdo.map[rpdo.number++] = object.word;
    tpdo.map[tpdo.number++] = object.word;
  }
  return table;
}

// Checks that the node transmits the initial values, receives random ones, and transmits these.
void check(std::vector<Mapped> objects, std::mt19937& random) {
  PdoNode node(mapping(objects));
  node.start();
  node.trigger(0);
  node.tx(notation(packed(0x181, objects)));
  for (Mapped& object : objects) {
    object.value = low_bits(static_cast<std::uint32_t>(random()), object.bits());
  }
  node.rx(packed(0x201, objects));
  node.trigger(0);
  node.tx(notation(packed(0x181, objects)));
}

constexpr std::uint32_t boolean(unsigned n) { return 0x22500001U | n << 8; }

// Returns the initial value of PdoVariables: byte k of sub-index s holds 16 s + k + 1.
Mapped number(unsigned bytes, unsigned sub) {
  std::uint32_t value = 0;
  for (unsigned k = 0; k < bytes; ++k) value |= (16 * sub + k + 1) << (8 * k);
  return {0x22000000U | bytes << 16 | sub << 8 | bytes * 8, value};
}

TEST_CASE("PDO bits: numbers of 1 to 4 bytes behind 0 to 8 single bits are transferred [M10]") {
  std::mt19937 random(1);
  for (unsigned bits = 0; bits <= 8; ++bits) {
    for (unsigned bytes = 1; bytes <= 4; ++bytes) {
      CAPTURE(bits);
      CAPTURE(bytes);
      std::vector<Mapped> objects;
      for (unsigned n = 1; n <= bits; ++n) objects.push_back({boolean(n), 0});
      objects.push_back(number(bytes, 1));
      check(objects, random);
      objects.push_back(number(2, 2));
      check(objects, random);
    }
  }
}

TEST_CASE("PDO bits: random mixtures of bits and numbers are transferred [M10]") {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    std::vector<Mapped> objects;
    unsigned used = 0;
    for (unsigned n = 1; n <= 8; ++n) {
      const auto bytes = static_cast<unsigned>(random() % 5);
      const Mapped object = bytes == 0 ? Mapped{boolean(n), 0} : number(bytes, n);
      if (used + object.bits() <= 64) {
        used += object.bits();
        objects.push_back(object);
      }
    }
    check(objects, random);
  }
}

TEST_CASE("PDO bits: adjacent variables on whole bytes are transferred") {
  std::mt19937 random(3);
  check(
      {number(1, 1), number(1, 2), number(1, 3), number(1, 4), number(1, 5), number(1, 6), number(1, 7), number(1, 8)},
      random);
  check({number(2, 1), number(2, 2), number(2, 3), number(2, 4)}, random);
  check({number(4, 1), number(4, 2)}, random);
}

TEST_CASE("PDO bits: each of 64 bits is sent and received as one object") {
  for (unsigned bit = 0; bit < 64; ++bit) {
    PdoTable table;
    PdoEntries& rpdo = table.rpdo[0].on(0x201, 255, {});
    PdoEntries& tpdo = table.tpdo[0].on(0x40000181, 255, {});
    for (unsigned n = 0; n < 64; ++n) {
      const std::uint32_t word = boolean(n == bit ? 1 : 2);
      rpdo.map[rpdo.number++] = n == bit ? word : 0x00010001;  // dummy of 1 bit
      tpdo.map[tpdo.number++] = word;
    }
    PdoNode node(table);
    node.start();
    node.boolean[0] = 1;
    node.trigger(0);
    CO_IF_FRM expected{0x181, {}, 8};
    expected.Data[bit / 8] = static_cast<std::uint8_t>(1U << bit % 8);
    node.tx(notation(expected));
    CO_IF_FRM in{0x201, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}, 8};
    in.Data[bit / 8] = static_cast<std::uint8_t>(~(1U << bit % 8));
    node.rx(in);
    CHECK(node.boolean[0] == 0);
    expected.Identifier = 0x201;
    node.rx(expected);
    CHECK(node.boolean[0] == 1);
    CHECK(node.error() == CO_ERR_NONE);
  }
}

TEST_CASE("PDO bits: an object of 8 bytes and larger ones behind bits are transferred") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {boolean(1), 0x22070138, boolean(2)});
  PdoNode node(table);
  node.start();
  node.rx("201#0304050607080902");
  CHECK(node.boolean[0] == 1);
  CHECK(node.u56[0] == 0x04840383028201);
  CHECK(node.boolean[1] == 1);
}

TEST_CASE("PDO bits: a frame is too short only without the byte of its last mapped bit: EMCY 8210h [X5]") {
  PdoTable table;
  table.rpdo[0].on(0x201, 255, {0x22010108, boolean(1), boolean(2)});
  PdoNode node(table);
  node.start();
  node.rx("201#4203");
  node.silent();
  CHECK(node.boolean[1] == 1);
  node.rx("201#42");
  CHECK(node.frames() == reports({emcy(0x8210, 1)}));
  node.rx("201#42FF00");
  CHECK(node.frames() == reports({emcy(0, 1), emcy(0x8220, 1)}));
}

TEST_CASE("PDO bits: each of 64 objects has its own flag for received and sent") {
  PdoTable table;
  PdoEntries& rpdo = table.rpdo[0].on(0x201, 255, {});
  for (unsigned n = 0; n < 63; ++n) rpdo.map[rpdo.number++] = boolean(1);
  rpdo.map[rpdo.number++] = boolean(2);
  PdoNode node(table);
  node.start();
  node.rx("201#0000000000000080");
  bool was = false;
  node.call([&] { was = CORPdoObjWasReceived(&node.node, node.find(0x2250, 2)); });
  CHECK(was);
  node.call([&] { was = CORPdoObjWasReceived(&node.node, node.find(0x2250, 2)); });
  CHECK_FALSE(was);
  node.call([&] { was = CORPdoObjWasReceived(&node.node, node.find(0x2250, 1)); });
  CHECK(was);
}

}  // namespace

#endif
