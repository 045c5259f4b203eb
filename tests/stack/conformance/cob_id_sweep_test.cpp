// SPDX-License-Identifier: Apache-2.0
// Writes each of the 2048 11-bit CAN-IDs to each object that contains a COB-ID. [301:7.3.5] [Other 10]
#include "support/pdo_model.hpp"

namespace {

using namespace test;

constexpr std::uint32_t abort_range = 0x06090030;
constexpr std::uint32_t off = 0x80000000;

bool is_refused(std::uint32_t id) { return CO_RESTRICTED_IDS == 0 && is_restricted(id); }

/// An object with a COB-ID, which is writable after the bits \a pause are set in it.
struct Object {
  std::uint16_t index;
  std::uint8_t sub;
  std::uint32_t pause;
  std::vector<std::uint32_t> flags;  ///< upper bits with which a restricted CAN-ID is refused
};

std::vector<Object> objects() {
  std::vector<Object> all = {{0x1400, 1, off, {0, 0x40000000}}, {0x1800, 1, off, {0x40000000}}};
  if (USE_PDO_RTR != 0) {
    all[1].flags.push_back(0);
  }
#if USE_SYNC
  all.push_back({0x1005, 0, 0, {0, 0x40000000, 0x80000000, 0xC0000000}});
#endif
#if USE_TIME
  all.push_back({0x1012, 0, 0, {0, 0x40000000, 0x80000000, 0xC0000000}});
#endif
#if USE_EMCY
  all.push_back({0x1014, 0, off, {0, 0x80000000}});
#endif
#if CO_SSDO_N >= 2
  all.push_back({0x1201, 1, off, {0}});
  all.push_back({0x1201, 2, off, {0}});
#endif
  return all;
}

/// A node with the objects of objects() and a mapping of RPDO 0 and TPDO 0. No PDO is valid.
struct Sweep : PdoNode {
  explicit Sweep(std::uint32_t* memory) : PdoNode(mapped(), [=](Setup& setup) { add(setup, memory); }) {}

  static PdoTable mapped() {
    PdoTable table;
    table.rpdo[0].on(0x80000201, 255, {0x22010108});
    table.tpdo[0].on(0xC0000181, 254, {0x22010208});
    return table;
  }

  static void add([[maybe_unused]] Setup& setup, [[maybe_unused]] std::uint32_t* memory) {
#if USE_SYNC
    memory[0] = 0x80;
    setup.with({CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, &memory[0]});
#endif
#if USE_TIME
    memory[1] = 0x100;
    setup.with({CO_KEY(0x1012, 0, CO_OBJ_____RW), CO_TTIME_ID, &memory[1]});
#endif
#if USE_EMCY
    memory[2] = 0x80000081;
    setup.with({CO_KEY(0x1014, 0, CO_OBJ_____RW), CO_TEMCY_ID, &memory[2]});
#endif
  }
};

TEST_CASE("COB-ID sweep: CiA 301 restricts 797 CAN-IDs [Other 10]") {
  unsigned number = 0;
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) {
    number += is_restricted(id) ? 1U : 0U;
  }
  CHECK(number == 797);
}

TEST_CASE(
    "COB-ID sweep: restricted CAN-IDs are refused with 0609 0030h, and change nothing [Other 10] [P5] [Y2] [E5]") {
  for (const Object& one : objects()) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    std::uint32_t memory[3];
    Sweep node(memory);
    const std::uint64_t before = node.get(one.index, one.sub);
    for (std::uint32_t id = 0; id <= 0x7FF; id += stride(31)) {
      if (!is_refused(id)) {
        continue;
      }
      for (const std::uint32_t flags : one.flags) {
        CAPTURE(id);
        CAPTURE(flags);
        CHECK(node.set(one.index, one.sub, 4, id | flags) == abort_range);
      }
    }
    CHECK(node.get(one.index, one.sub) == before);
    node.silent();
  }
}

TEST_CASE("COB-ID sweep: all other CAN-IDs are accepted and read back [P1] [P5] [Y1] [E5]") {
  for (const Object& one : objects()) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    std::uint32_t memory[3];
    Sweep node(memory);
    const std::uint32_t flags = one.index == 0x1800 ? 0x40000000 : 0;
    for (std::uint32_t id = 0; id <= 0x7FF; id += stride(31)) {
      if (is_refused(id) || (CO_RESTRICTED_IDS != 0 && (id == 0 || is_restricted(id)))) {
        continue;
      }
      CAPTURE(id);
      REQUIRE(node.set(one.index, one.sub, 4, id | flags | one.pause) == 0);
      REQUIRE(node.set(one.index, one.sub, 4, id | flags) == 0);
      REQUIRE(node.get(one.index, one.sub) == (id | flags));
      REQUIRE(node.set(one.index, one.sub, 4, id | flags | one.pause) == 0);
    }
    node.silent();
  }
}

TEST_CASE("COB-ID sweep: a CAN-ID above 7FFh without bit 29 is aborted with 0609 0030h [P4] [Y2]") {
  for (const Object& one : objects()) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    std::uint32_t memory[3];
    Sweep node(memory);
    const std::uint32_t flags = one.index == 0x1800 ? 0x40000000 : 0;
    for (unsigned bit = 11; bit <= 28; ++bit) {
      CAPTURE(bit);
      CHECK(node.set(one.index, one.sub, 4, 1U << bit | 0x200U | flags) == abort_range);
    }
    const std::uint32_t wide = 0x20012345 | flags;
    CHECK(node.set(one.index, one.sub, 4, wide | one.pause) == 0);
    CHECK(node.set(one.index, one.sub, 4, wide) == 0);
    CHECK(node.get(one.index, one.sub) == wide);
  }
}

TEST_CASE("COB-ID sweep: an invalid PDO (bit 31) accepts any CAN-ID [P5]") {
  std::uint32_t memory[3];
  Sweep node(memory);
  for (std::uint32_t id = 0; id <= 0x7FF; id += stride(31)) {
    CAPTURE(id);
    REQUIRE(node.set(0x1400, 1, 4, id | off) == 0);
    REQUIRE(node.get(0x1400, 1) == (id | off));
    REQUIRE(node.set(0x1800, 1, 4, id | off) == 0);
    REQUIRE(node.get(0x1800, 1) == (id | off));
  }
}

TEST_CASE("COB-ID sweep: a PDO works on every accepted CAN-ID, and not after it is switched off [P1]") {
  std::uint32_t memory[3];
  Sweep node(memory);
  CHECK(node.set(0x1400, 1, 4, 0x80000201) == 0);
  node.start();
  std::uint8_t value = 0;
  CO_IF_FRM frame{};
  frame.DLC = 1;
  for (std::uint32_t id = 0; id <= 0x7FF; id += stride(31)) {
    // SYNC, TIME and EMCY of this node: consumed with other lengths.
    const bool of_another = id == 0x080 || id == 0x100 || id == 0x081;
    if (is_refused(id) || of_another || (CO_RESTRICTED_IDS != 0 && (id == 0 || is_restricted(id)))) {
      continue;
    }
    CAPTURE(id);
    REQUIRE(node.set(0x1400, 1, 4, id) == 0);
    frame.Identifier = id;
    frame.Data[0] = ++value;
    node.rx(frame);
    node.silent();
    REQUIRE(node.u8[0] == value);
    REQUIRE(node.set(0x1400, 1, 4, id | off) == 0);
    frame.Data[0] = static_cast<std::uint8_t>(value + 1);
    node.rx(frame);
    REQUIRE(node.u8[0] == value);

    REQUIRE(node.set(0x1800, 1, 4, id | 0x40000000) == 0);
    node.trigger(0);
    REQUIRE(node.can.sent.size() == 1);
    REQUIRE(node.can.sent[0].frm.Identifier == id);
    node.frames();
    REQUIRE(node.set(0x1800, 1, 4, id | 0xC0000000) == 0);
    node.trigger(0);
    REQUIRE(node.can.sent.empty());
  }
}

}  // namespace
