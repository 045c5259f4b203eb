// SPDX-License-Identifier: Apache-2.0
// 1400h… and 1800h…, sub-index 2 to 6: communication parameters except the COB-ID. [301:7.5.2.35, 7.5.2.37]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

constexpr std::uint32_t abort_range = 0x06090030;
constexpr std::uint32_t abort_sub = 0x06090011;

PdoTable both_on(std::uint8_t rpdo_type = 255, std::uint8_t tpdo_type = 254) {
  PdoTable table;
  table.rpdo[0].on(0x201, rpdo_type, {0x22010108});
  table.tpdo[0].on(0x40000181, tpdo_type, {0x22020110});
  return table;
}

void switch_off(PdoNode& node) {
  REQUIRE(node.set(0x1400, 1, 4, 0x80000201) == 0);
  REQUIRE(node.set(0x1800, 1, 4, 0xC0000181) == 0);
}

void switch_on(PdoNode& node) {
  REQUIRE(node.set(0x1400, 1, 4, 0x201) == 0);
  REQUIRE(node.set(0x1800, 1, 4, 0x40000181) == 0);
}

// Lengths and access rights -------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: sub 0 is the highest sub-index and read-only") {
  PdoNode node;
  node.ask("601#4000140000000000", "581#4F00140005000000");
  node.ask("601#4000180000000000", "581#4F00180006000000");
  node.ask("601#2F00140005000000", "581#8000140002000106");
}

TEST_CASE("PDO communication: a wrong length is refused for every parameter [D5]") {
  struct Parameter {
    std::uint16_t index;
    std::uint8_t sub;
    unsigned bytes;
    std::uint64_t value;
  };
  const Parameter parameters[] = {{0x1400, 2, 1, 254}, {0x1400, 3, 2, 0}, {0x1400, 5, 2, 0}, {0x1800, 2, 1, 254},
                                  {0x1800, 3, 2, 0},   {0x1800, 5, 2, 0}, {0x1800, 6, 1, 0}, {0x1600, 0, 1, 0},
                                  {0x1600, 1, 4, 0},   {0x1A00, 0, 1, 0}, {0x1A00, 1, 4, 0}};
  PdoNode node;
  for (const Parameter& one : parameters) {
    CAPTURE(one.index);
    CAPTURE(unsigned{one.sub});
    CHECK(node.upload(one.index, one.sub).size() == one.bytes);
    for (unsigned bytes = 1; bytes <= 4; ++bytes) {
      const std::uint32_t expected = bytes > one.bytes ? 0x06070012 : bytes < one.bytes ? 0x06070013 : 0;
      CHECK(node.set(one.index, one.sub, bytes, one.value) == expected);
    }
  }
}

// Sub 2, transmission type --------------------------------------------------------------------------------------------

bool is_type(bool of_tpdo, unsigned value) {
  if (of_tpdo) {
    const bool is_remote = value == 252 || value == 253;
    return value <= 240 || value >= 254 || (is_remote && USE_PDO_RTR != 0);
  }
  return value <= 240 || value >= 254;
}

// Returns true for synchronous types. Without USE_SYNC, writes of these types are not checked.
bool is_synchronous(unsigned value) { return value <= 240; }

void check_types(PdoNode& node) {
  for (unsigned value = 0; value <= 255; value += value < 235 ? stride(13) : 1) {
    CAPTURE(value);
    if (USE_SYNC == 0 && is_synchronous(value)) {
      continue;
    }
    const std::uint64_t before[] = {node.get(0x1400, 2), node.get(0x1800, 2)};
    CHECK(node.set(0x1400, 2, 1, value) == (is_type(false, value) ? 0U : abort_range));
    CHECK(node.get(0x1400, 2) == (is_type(false, value) ? value : before[0]));
    CHECK(node.set(0x1800, 2, 1, value) == (is_type(true, value) ? 0U : abort_range));
    CHECK(node.get(0x1800, 2) == (is_type(true, value) ? value : before[1]));
  }
}

TEST_CASE("PDO communication: reserved transmission types are refused with 0609 0030h while the PDO is off [P7] [P8]") {
  PdoNode node;
  check_types(node);
}

TEST_CASE(
    "PDO communication: reserved transmission types are refused, others accepted while the PDO exists [P7] [P8]") {
  PdoNode node(both_on());
  check_types(node);
  node.start();
  check_types(node);
  node.frames();
}

TEST_CASE("PDO communication: the transmission type is written and read by SDO [P7]") {
  PdoNode node(both_on());
  node.ask("601#2F001402F1000000", "581#8000140230000906");
  node.ask("601#2F001402FD000000", "581#8000140230000906");
  node.ask("601#2F001402FE000000", "581#6000140200000000");
  node.ask("601#4000140200000000", "581#4F001402FE000000");
  node.ask("601#2F001802F1000000", "581#8000180230000906");
  node.ask("601#2F001802FB000000", "581#8000180230000906");
  node.ask("601#2F001802FF000000", "581#6000180200000000");
  node.ask("601#4000180200000000", "581#4F001802FF000000");
}

#if USE_PDO_RTR

TEST_CASE("PDO communication: 252 and 253 may be written before and after bit 30 of the COB-ID [P8]") {
  for (const unsigned type : {252U, 253U}) {
    CAPTURE(type);
    PdoNode node(both_on());
    CHECK(node.set(0x1800, 2, 1, type) == 0);
    CHECK(node.set(0x1800, 1, 4, 0xC0000181) == 0);
    CHECK(node.set(0x1800, 2, 1, 254) == 0);
    CHECK(node.set(0x1800, 2, 1, type) == 0);
    CHECK(node.set(0x1800, 1, 4, 0x40000181) == 0);
  }
}

#endif

#if USE_SYNC

void add_sync(Setup& setup) { setup.with({CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, CO_COBID_SYNC_STD(0, 0x80)}); }

TEST_CASE("PDO communication: the transmission type of an RPDO takes effect at once [P7]") {
  PdoNode node(both_on(), add_sync);
  node.start();
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  CHECK(node.set(0x1400, 2, 1, 1) == 0);
  node.rx("201#2B");
  CHECK(node.u8[0] == 0x2A);
  node.rx("080#");
  CHECK(node.u8[0] == 0x2B);
  CHECK(node.set(0x1400, 2, 1, 254) == 0);
  node.rx("201#2C");
  CHECK(node.u8[0] == 0x2C);
  node.u8[0] = 0x2D;
  node.rx("080#");
  CHECK(node.u8[0] == 0x2D);
}

TEST_CASE("PDO communication: data received before a change of type is not written by the next SYNC [P7]") {
  PdoNode node(both_on(1), add_sync);
  node.start();
  node.rx("201#2A");
  CHECK(node.set(0x1400, 2, 1, 255) == 0);
  node.rx("201#2B");
  CHECK(node.u8[0] == 0x2B);
  node.rx("080#");
  CHECK(node.u8[0] == 0x2B);
}

TEST_CASE("PDO communication: the transmission type of a TPDO takes effect at once [P7]") {
  PdoNode node(both_on(), add_sync);
  node.start();
  node.rx("080#");
  node.silent();
  CHECK(node.set(0x1800, 2, 1, 1) == 0);
  node.silent();
  node.trigger(0);
  node.silent();
  node.rx("080#");
  node.tx("181#1112");
  CHECK(node.set(0x1800, 2, 1, 2) == 0);
  node.rx("080#");
  node.silent();
  node.rx("080#");
  node.tx("181#1112");
  CHECK(node.set(0x1800, 2, 1, 255) == 0);
  node.rx("080#");
  node.rx("080#");
  node.silent();
  node.trigger(0);
  node.tx("181#1112");
}

TEST_CASE("PDO communication: an event before a change of type is not sent by the next SYNC [P7]") {
  PdoNode node(both_on(255, 0), add_sync);
  node.start();
  node.rx("080#");
  node.tx("181#1112");
  node.trigger(0);
  node.silent();
  CHECK(node.set(0x1800, 2, 1, 254) == 0);
  node.frames();  // the event may be sent at once or be discarded
  node.rx("080#");
  node.silent();
}

#endif

// Sub 3, inhibit time -------------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: the inhibit time of an existing TPDO cannot be changed: 0609 0030h [P9]") {
  PdoTable table = both_on();
  table.tpdo[0].inhibit = 100;
  PdoNode node(table);
  node.ask("601#2B00180365000000", "581#8000180330000906");
  node.ask("601#2B00180300000000", "581#8000180330000906");
  node.ask("601#2B00180364000000", "581#6000180300000000");
  CHECK(node.get(0x1800, 3) == 100);
  node.start();
  CHECK(node.set(0x1800, 3, 2, 101) == abort_range);
  CHECK(node.set(0x1800, 3, 2, 100) == 0);
  switch_off(node);
  for (const unsigned value : {0U, 1U, 101U, 65535U}) {
    CHECK(node.set(0x1800, 3, 2, value) == 0);
    CHECK(node.get(0x1800, 3) == value);
  }
  CHECK(node.set(0x1800, 3, 2, 500) == 0);
  switch_on(node);
  CHECK(node.set(0x1800, 3, 2, 0) == abort_range);
  node.trigger(0);
  node.tx("181#1112");
  node.trigger(0);
  node.after(49ms);
  node.silent();
  node.after(1ms);
  node.tx("181#1112");
  node.after(50ms);
}

TEST_CASE("PDO communication: an inhibit time of a basic type is read when the TPDO is switched on [P9]") {
  std::uint16_t inhibit = 0;
  PdoNode node(both_on(), [&](Setup& setup) {
    setup.with({CO_KEY(0x1800, 3, CO_OBJ_____RW), CO_TUNSIGNED16, &inhibit});
  });
  node.start();
  CHECK(node.set(0x1800, 3, 2, 500) == 0);
  node.trigger(0);
  node.trigger(0);
  node.tx({"181#1112", "181#1112"});
  switch_off(node);
  switch_on(node);
  node.trigger(0);
  node.tx("181#1112");
  node.trigger(0);
  node.silent();
  node.after(50ms);
  node.tx("181#1112");
  node.after(50ms);
}

// Sub 4 ---------------------------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: sub 4 does not exist: 0609 0011h [P10]") {
  for (const PdoTable& table : {PdoTable(), both_on()}) {
    PdoNode node(table);
    node.ask("601#4000140400000000", "581#8000140411000906");
    node.ask("601#2F00140400000000", "581#8000140411000906");
    node.ask("601#4000180400000000", "581#8000180411000906");
    node.ask("601#2F00180400000000", "581#8000180411000906");
    CHECK(node.set(0x1400, 6, 1, 0) == abort_sub);
    CHECK(node.set(0x1800, 7, 1, 0) == abort_sub);
  }
}

// Sub 5, event timer --------------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: the event timer may be written at any time [P11]") {
  PdoNode node(both_on());
  for (int states = 0; states < 2; ++states) {
    for (const unsigned value : {0U, 1U, 1000U, 65535U, 0U}) {
      CAPTURE(value);
      CHECK(node.set(0x1400, 5, 2, value) == 0);
      CHECK(node.get(0x1400, 5) == value);
      CHECK(node.set(0x1800, 5, 2, value) == 0);
      CHECK(node.get(0x1800, 5) == value);
    }
    node.start();
  }
  switch_off(node);
  CHECK(node.set(0x1400, 5, 2, 100) == 0);
  CHECK(node.set(0x1800, 5, 2, 100) == 0);
  node.after(300ms);
  node.silent();
}

TEST_CASE("PDO communication: the event timer of a TPDO takes effect at once; 0 stops it [P11] [D39]") {
  PdoNode node(both_on());
  node.start();
  node.ask("601#2B00180564000000", "581#6000180500000000");
  node.after(250ms);
  node.tx_at(100ms, "181#1112");
  node.tx_at(200ms, "181#1112");
  node.ask("601#2B0018051E000000", "581#6000180500000000");
  node.after(70ms);
  node.tx_at(30ms, "181#1112");
  node.tx_at(60ms, "181#1112");
  node.ask("601#2B00180500000000", "581#6000180500000000");
  node.after(1000ms);
  node.silent();
  CHECK(node.armed_timers() == 0);
}

TEST_CASE("PDO communication: thirty changes of the event timer leave one running timer [P11] [D38] [D39]") {
  PdoNode node(both_on());
  node.start();
  for (unsigned times = 0; times < 30; ++times) {
    CHECK(node.set(0x1800, 5, 2, 100 + times) == 0);
  }
  CHECK(node.armed_timers() == 1);
  node.after(300ms);
  node.tx_at(129ms, "181#1112");
  node.tx_at(258ms, "181#1112");
  node.silent();
}

TEST_CASE("PDO communication: an event timer that was written in Pre-operational runs in Operational [P11]") {
  PdoNode node(both_on());
  CHECK(node.set(0x1800, 5, 2, 100) == 0);
  node.after(300ms);
  node.silent();
  node.start();
  node.after(250ms);
  CHECK(node.trace() == std::vector<std::string>{"100 181#1112", "200 181#1112"});
}

// Sub 6, SYNC start value ---------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: SYNC start values above 240 are refused with 0609 0030h [P12]") {
  PdoNode node;
  for (unsigned value = 0; value <= 255; ++value) {
    CAPTURE(value);
    CHECK(node.set(0x1800, 6, 1, value) == (value <= 240 ? 0U : abort_range));
    CHECK(node.get(0x1800, 6) == std::min(value, 240U));
  }
  node.ask("601#2F001806F1000000", "581#8000180630000906");
}

TEST_CASE("PDO communication: the SYNC start value of an existing TPDO cannot be changed [P12]") {
  PdoTable table = both_on();
  table.tpdo[0].start = 3;
  PdoNode node(table);
  for (unsigned value = 0; value <= 255; ++value) {
    CAPTURE(value);
    CHECK(node.set(0x1800, 6, 1, value) == (value == 3 ? 0U : abort_range));
  }
  node.ask("601#2F00180603000000", "581#6000180600000000");
  node.ask("601#2F00180604000000", "581#8000180630000906");
  CHECK(node.get(0x1800, 6) == 3);
  switch_off(node);
  CHECK(node.set(0x1800, 6, 1, 4) == 0);
  switch_on(node);
  CHECK(node.set(0x1800, 6, 1, 3) == abort_range);
}

// All sub-indexes -----------------------------------------------------------------------------------------------------

TEST_CASE("PDO communication: missing entries mean 0, except for the COB-ID") {
  PdoNode node(both_on(), [](Setup& setup) {
    for (const std::uint8_t sub : {std::uint8_t{3}, std::uint8_t{5}, std::uint8_t{6}}) {
      setup.without(0x1400, sub).without(0x1800, sub);
    }
  });
  CHECK(node.error() == CO_ERR_NONE);
  node.start();
  node.rx("201#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.trigger(0);
  node.tx({"181#1112", "181#1112"});
  node.after(1000ms);
  node.silent();
}

TEST_CASE("PDO communication: after a reset communication the parameters are those of the dictionary") {
  PdoNode node(both_on());
  node.start();
  node.tpdo[0].event = 100;
  node.tpdo[0].inhibit = 500;
  node.after(500ms);
  node.silent();
  node.rx("000#8201");
  node.tx("701#00");
  node.start();
  node.after(250ms);
  CHECK(node.trace() == std::vector<std::string>{"100 181#1112", "200 181#1112"});
  node.trigger(0);
  node.after(50ms);
  node.tx_at(0ms, "181#1112");
  node.trigger(0);
  node.after(50ms);
  node.tx_at(0ms, "181#1112");
}

}  // namespace
