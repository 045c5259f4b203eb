// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs with every address, and with random frames and writes. [301:7.2.3]
#include <random>

#include "support/mpdo_fixture.hpp"

#if CO_MPDO_N > 0 && CO_RPDO_N > 0 && CO_TPDO_N > 0

namespace {

using namespace test;

CO_IF_FRM frame_of(unsigned address, std::uint32_t key, std::uint32_t data) {
  CO_IF_FRM frm{0x201, {}, 8};
  CO_SET_BYTE(&frm, address, 0);
  CO_SET_WORD(&frm, key >> 16, 1);
  CO_SET_BYTE(&frm, key >> 8 & 0xFF, 3);
  CO_SET_LONG(&frm, data, 4);
  return frm;
}

TEST_CASE("MPDO sweep: destination addressing: every address byte with existing and missing objects") {
  for (const std::uint8_t id : {std::uint8_t{1}, std::uint8_t{64}, std::uint8_t{127}}) {
    MpdoTable table;
    table.rpdo[0].on(0x201, 255, {}).number = dam;
    MpdoNode node(table, [&](Setup& setup) { setup.node_id(id); });
    node.rx(CO_IF_FRM{0x000, {0x01, id}, 2});
    bool reported = false;
    for (unsigned address = 0; address < 256; ++address) {
      CAPTURE(address);
      for (const std::uint32_t key : {CO_DEV(0x2201, 1), CO_DEV(0x2204, 8), CO_DEV(0x2208, 1), CO_DEV(0x2241, 1),
                                      CO_DEV(0x3000, 0), CO_DEV(0x0005, 0), CO_DEV(0xFFFF, 0xFF), CO_DEV(0, 0)}) {
        CAPTURE(key);
        node.u8[0] = 0;
        node.u32[7] = 0;
        const std::uint32_t malformed = node.counters().Malformed;
        node.rx(frame_of(address, key, 0x5A6B7C8D));
        const bool to_consumer = (address & 0x80) != 0;
        const bool mine = to_consumer && ((address & 0x7F) == 0 || (address & 0x7F) == id);
        const bool exists = key == CO_DEV(0x2201, 1) || key == CO_DEV(0x2204, 8);
        CHECK(node.u8[0] == (mine && key == CO_DEV(0x2201, 1) ? 0x8D : 0));
        CHECK(node.u32[7] == (mine && key == CO_DEV(0x2204, 8) ? 0x5A6B7C8D : 0));
        CHECK(node.counters().Malformed - malformed == (to_consumer ? 0 : 1));
        CHECK(node.frames().size() == (USE_EMCY != 0 && mine && reported == exists ? 1 : 0));
        reported = mine ? !exists : reported;
      }
    }
    CHECK(node.n8 == 0x11);
    CHECK(node.u64[0] == 0x1817161514131211);
  }
}

TEST_CASE("MPDO sweep: every address byte and sub-index against a block of the dispatching list") {
  MpdoTable table;
  table.rpdo[0].on(0x201, 255, {}).number = sam;
  table.dispatch[0] = 0x0322010360008005U;
  MpdoNode node(table);
  node.start();
  for (unsigned address = 0; address < 256; ++address) {
    for (unsigned sub = 0; sub < 256; sub += address == 5 ? 1 : 64) {
      CAPTURE(address);
      CAPTURE(sub);
      std::fill(std::begin(node.u8), std::end(node.u8), std::uint8_t{0});
      node.rx(frame_of(address, CO_DEV(0x6000, sub), 0xA5));
      for (unsigned n = 0; n < 8; ++n) {
        const bool written = address == 5 && sub >= 0x80 && sub <= 0x82 && n == sub - 0x80 + 2;
        CHECK(node.u8[n] == (written ? 0xA5 : 0));
      }
    }
  }
  node.silent();
}

TEST_CASE("MPDO sweep: of every index and sub-index only mappable objects of up to 4 bytes are written") {
  MpdoTable table;
  table.rpdo[0].on(0x201, 255, {}).number = dam;
  MpdoNode node(table);
  node.start();
  for (std::uint16_t n = 0; n < node.node.Dict.Num; ++n) {
    CO_OBJ& obj = node.node.Dict.Root[n];
    CAPTURE(obj.Key);
    const std::uint32_t size = COObjGetSize(&obj, &node.node, 0);
    const bool writable = CO_IS_PDOMAP(obj.Key) != 0 && CO_IS_WRITE(obj.Key) != 0 && size >= 1 && size <= 4;
    node.rx(frame_of(0x81, CO_GET_DEV(obj.Key), 0x01010101));
    bool was = false;
    node.call([&] { was = CORPdoWasReceived(&node.node, 0); });
    CHECK(was == writable);
    node.frames();
  }
}

TEST_CASE("MPDO sweep: random frames, lists, kinds and calls never write an object that is not allowed") {
  std::mt19937 random(301);
  const auto any_word = [&] { return static_cast<std::uint32_t>(random()); };
  const auto any = [&](std::uint32_t below) { return any_word() % below; };
  const auto any_of = [&](std::initializer_list<std::uint32_t> all) {
    return all.begin()[any(static_cast<std::uint32_t>(all.size()))];
  };
  const auto any_object = [&] {
    return any_of({0x220101, 0x220108, 0x221101, 0x221203, 0x220401, 0x220801, 0x300001, 0x224101, any(0x1000000)});
  };
  MpdoNode node;
  node.frames_per_call(40);
  for (unsigned step = 0; step < 30000 / stride(40); ++step) {
    CAPTURE(step);
    const auto n = static_cast<std::uint16_t>(any(2));
    const auto sub = static_cast<std::uint8_t>(any(4) + 1);
    switch (any(14)) {
      case 0: node.set(0x1600 + n, 0, 1, any_of({0, 0xFE, 0xFF, any(256)})); break;
      case 1: node.set(0x1A00 + n, 0, 1, any_of({0, 0xFE, 0xFF, any(256)})); break;
      case 2: node.set(0x1400 + n, 1, 4, any_of({0x201, 0x80000201})); break;
      case 3: node.set(0x1800 + n, 1, 4, any_of({0x181, 0x40000181, 0xC0000181}) + n); break;
      case 4: node.set(0x1800 + n, any_of({3, 5}) & 0xFF, 2, any(30)); break;
      case 5: node.set(0x1FA0, sub, 4, any(12) << 24 | any_object()); break;
      case 6:
        node.set(0x1FD0, sub, 8,
                 std::uint64_t{any(12)} << 56 | std::uint64_t{any_object()} << 32 | 0x60000000 | any(4) << 8 | any(3));
        break;
      case 7: (void)node.request(n); break;
      case 8: (void)node.send_to(n, static_cast<std::uint8_t>(any(130)), any_word(), any_word()); break;
      case 9: node.after(std::chrono::milliseconds{any(20)}); break;
      case 10: node.rx(any_of({0, 1}) != 0 ? "000#0101" : "000#8001"); break;
      case 11:
        node.can.refuse_next(any(4));
        (void)node.request(n);
        node.can.accept_all();
        break;
      default:
        node.rx(frame_of(any_of({0x81, 0x80, 1, 2, any(256)}), any_of({any_object() << 8, CO_DEV(0x6000, any(4))}),
                         any_word()));
        break;
    }
    node.frames();
    (void)node.error();
  }
  node.can.accept_all();
  node.rx("000#8201");
  node.frames();
  CHECK(node.n8 == 0x11);
  CHECK(node.r8 == 0x11);
  CHECK(node.u64[0] == 0x1817161514131211);
}

}  // namespace

#endif
