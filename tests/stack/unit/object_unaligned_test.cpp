// SPDX-License-Identifier: Apache-2.0
// COB-IDs of SDO servers and the heartbeat time, with variables and buffers of any alignment.
#include <cstring>

#include "support/entry.hpp"

namespace {

using namespace test;

// Memory with a variable at an odd address, between bytes that must not change.
struct Odd {
  alignas(8) std::uint8_t memory[32];
  unsigned shift;

  explicit Odd(unsigned by) : shift(by) { std::memset(memory, 0xEE, sizeof memory); }
  void* place() { return memory + 8 + shift; }
  template <class T>
  void set(T value) {
    std::memcpy(place(), &value, sizeof value);
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, place(), sizeof value);
    return value;
  }
  bool is_untouched_around(unsigned bytes) const {
    return memory[7 + shift] == 0xEE && memory[8 + shift + bytes] == 0xEE;
  }
};

TEST_CASE("unaligned: a COB-ID of an SDO server works in variable and buffer, also relative to the node-ID") {
  for (unsigned shift = 0; shift < 8; ++shift) {
    for (const bool relative : {false, true}) {
      CAPTURE(shift);
      CAPTURE(relative);
      Odd variable(shift);
      Odd buffer(7 - shift);
      const std::uint32_t node_id = relative ? 5 : 0;
      variable.set<std::uint32_t>(0x80000000);
      Entry entry(CO_TSDO_ID, relative ? CO_OBJ__N__RW : CO_OBJ_____RW, variable.place());
      CHECK(entry.size() == 4);
      CHECK(entry.read(buffer.place(), 4) == CO_ERR_NONE);
      CHECK(buffer.get<std::uint32_t>() == 0x80000000 + node_id);
      buffer.set<std::uint32_t>(0x00000690);
      CHECK(entry.write(buffer.place(), 4) == CO_ERR_NONE);
      CHECK(variable.get<std::uint32_t>() == 0x690 - node_id);
      buffer.set<std::uint32_t>(0);
      CHECK(entry.read(buffer.place(), 4) == CO_ERR_NONE);
      CHECK(buffer.get<std::uint32_t>() == 0x690);
      buffer.set<std::uint32_t>(0x691);
      CHECK(entry.write(buffer.place(), 4) == CO_ERR_OBJ_RANGE);
      CHECK(variable.get<std::uint32_t>() == 0x690 - node_id);
      CHECK(variable.is_untouched_around(4));
      CHECK(buffer.is_untouched_around(4));
    }
  }
}

TEST_CASE("unaligned: the heartbeat time works in variable and buffer") {
  for (unsigned shift = 0; shift < 8; ++shift) {
    CAPTURE(shift);
    Odd variable(shift);
    Odd buffer(7 - shift);
    variable.set<std::uint16_t>(0);
    Entry entry(CO_THB_PROD, CO_OBJ_____RW, variable.place());
    CHECK(entry.size() == 2);
    buffer.set<std::uint16_t>(0x1234);
    CHECK(entry.write(buffer.place(), 2) == CO_ERR_NONE);
    CHECK(variable.get<std::uint16_t>() == 0x1234);
    buffer.set<std::uint16_t>(0);
    CHECK(entry.read(buffer.place(), 2) == CO_ERR_NONE);
    CHECK(buffer.get<std::uint16_t>() == 0x1234);
    CHECK(variable.is_untouched_around(2));
    CHECK(buffer.is_untouched_around(2));
  }
}

TEST_CASE("unaligned: a COB-ID and the heartbeat time with another length are refused") {
  std::uint32_t cob_id = 0x80000000;
  std::uint16_t time = 0;
  Entry id(CO_TSDO_ID, CO_OBJ_____RW, &cob_id);
  Entry heartbeat(CO_THB_PROD, CO_OBJ_____RW, &time);
  std::uint8_t buffer[16] = {0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE, 0xEE};
  for (std::uint8_t width = 0; width < 9; ++width) {
    CAPTURE(width);
    if (width != 4) {
      CHECK(id.read(buffer, width) == CO_ERR_BAD_ARG);
      CHECK(id.write(buffer, width) == CO_ERR_BAD_ARG);
    }
    if (width != 2) {
      CHECK(heartbeat.read(buffer, width) == CO_ERR_BAD_ARG);
      CHECK(heartbeat.write(buffer, width) == CO_ERR_BAD_ARG);
    }
  }
  CHECK(cob_id == 0x80000000);
  CHECK(time == 0);
  CHECK(buffer[0] == 0xEE);
}

TEST_CASE("unaligned: a heartbeat time at an odd address works") {
  for (unsigned shift = 1; shift < 8; shift += 2) {
    CAPTURE(shift);
    Odd variable(shift);
    variable.set<std::uint16_t>(100);
    Fixture node(Setup().only_small().with({CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, variable.place()}));
    node.after(100ms);
    node.tx("701#7F");
    node.ask("601#2B17100032000000", "581#6017100000000000");
    node.ask("601#4017100000000000", "581#4B17100032000000");
    node.after(50ms);
    node.tx_at(50ms, "701#7F");
    CHECK(variable.get<std::uint16_t>() == 50);
  }
}

#if CO_SSDO_N >= 2

TEST_CASE("unaligned: an SDO server with COB-IDs at odd addresses works") {
  for (unsigned shift = 1; shift < 8; shift += 2) {
    CAPTURE(shift);
    Odd rx(shift);
    Odd tx(8 - shift);
    rx.set<std::uint32_t>(0x690);
    tx.set<std::uint32_t>(0x6A0);
    Fixture node(Setup()
                     .only_small()
                     .with({CO_KEY(0x1201, 1, CO_OBJ_____RW), CO_TSDO_ID, rx.place()})
                     .with({CO_KEY(0x1201, 2, CO_OBJ_____RW), CO_TSDO_ID, tx.place()}));
    node.ask("690#4000100000000000", "6A0#4300100091010F00");
    node.ask("601#2301120190060080", "581#6001120100000000");
    node.ask("601#2301120191060000", "581#6001120100000000");
    node.ask("691#4001120100000000", "6A0#4301120191060000");
    CHECK(rx.get<std::uint32_t>() == 0x691);
  }
}

#endif

}  // namespace
