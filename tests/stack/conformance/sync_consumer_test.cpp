// SPDX-License-Identifier: Apache-2.0
// SYNC consumer: 1005h, 1007h, 1019h. [301:7.2.5, 7.5.2.5-7, 7.5.2.22]
#include "support/restricted_ids.hpp"
#include "support/sync_fixture.hpp"

namespace {

using namespace test;

#if USE_SYNC && CO_TPDO_N > 1

SyncTable with_counter(std::uint8_t counter = 0) {
  SyncTable table;
  table.tpdo[0].on(0x40000181, 1, {0x22010108});
  table.tpdo[1].on(0x40000281, 1, {0x22010208}).start = 1;
  table.counter = counter;
  return table;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST_CASE("SYNC consumer: 1005h is read as 80h [SYNC 01]") {
  SyncNode node;
  node.ask("601#4005100000000000", "581#4305100080000000");
}

TEST_CASE(
    "SYNC consumer: SYNC is counted as claimed in Operational and Pre-operational, as unclaimed in Stopped [N3]") {
  SyncNode node(with_counter());
  node.rx("080#");
  CHECK(node.counters().Unclaimed == 0);
  node.start();
  node.rx("080#");
  node.tx({"181#11", "281#21"});
  CHECK(node.counters().Unclaimed == 0);
  CHECK(node.counters().Malformed == 0);
  node.rx("000#0201");
  node.rx("080#");
  node.silent();
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("SYNC consumer: a new CAN-ID takes effect at once, and the old one is no longer SYNC [Y1]") {
  SyncNode node(with_counter());
  node.start();
  CHECK(node.set(0x1005, 0, 4, 0x90) == 0);
  node.rx("080#");
  node.silent();
  node.rx("090#");
  node.tx({"181#11", "281#21"});
  CHECK(node.set(0x1005, 0, 4, 0x20000080) == 0);
  node.rx("080#");
  node.rx("090#");
  node.silent();
  node.rx("00000080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: without 1005h no SYNC is received") {
  SyncNode node(with_counter(), [](Setup& setup) {
    for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1005, 0x1006, 0x1007, 0x1019})
      setup.without(index, 0);
  });
  node.start();
  node.rx("080#");
  node.silent();
  CHECK(node.counters().Unclaimed == 1);
}

TEST_CASE("SYNC consumer: 1006h, 1007h and 1019h are not needed") {
  SyncNode node(with_counter(), [](Setup& setup) {
    for (const std::uint16_t index : std::initializer_list<std::uint16_t>{0x1006, 0x1007, 0x1019})
      setup.without(index, 0);
  });
  node.start();
  node.rx("080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: a length that differs from 1019h is reported with 8240h; PDOs run without a counter [Y7]") {
  for (std::uint8_t dlc = 1; dlc <= 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    SyncNode node(with_counter());
    node.start();
    node.rx(CO_IF_FRM{0x80, {5}, dlc});
    CHECK(node.frames() == joined({"181#11", "281#21"}, reports({emcy(0x8240)})));
    CHECK(node.counters().Malformed == 1);
  }
}

TEST_CASE("SYNC consumer: with a counter a SYNC of another length sends only PDOs without start value [Y7]") {
  for (std::uint8_t dlc = 0; dlc <= 8; ++dlc) {
    CAPTURE(unsigned{dlc});
    SyncNode node(with_counter(10));
    node.start();
    node.rx(CO_IF_FRM{0x80, {1}, dlc});
    const std::vector<std::string> sent = node.frames();
    if (dlc == 1) {
      CHECK(sent == std::vector<std::string>{"181#11", "281#21"});
    } else {
      CHECK(sent == joined({"181#11"}, reports({emcy(0x8240)})));
    }
  }
}

TEST_CASE("SYNC consumer: 8240h is reported once and resolved by a SYNC of the right length [Y7] [N2]") {
  SyncNode node(with_counter());
  for (int round = 0; round < 3; ++round) {
    node.rx("080#01");
    CHECK(node.frames() == reports({emcy(0x8240)}));
    node.rx("080#02");
    node.silent();
    CHECK(node.objects.error_register == (USE_EMCY != 0 ? 0x11 : 0));
    node.rx("080#");
    CHECK(node.frames() == reports({emcy(0)}));
    CHECK(node.objects.error_register == 0);
    node.rx("080#");
    node.silent();
  }
}

TEST_CASE("SYNC consumer: a reset clears a wrong length") {
  SyncNode node(with_counter());
  node.rx("080#01");
  node.frames();
  node.rx("000#8201");
  node.tx("701#00");
  CHECK(node.objects.error_register == 0);
  node.rx("080#01");
  CHECK(node.frames() == reports({emcy(0x8240)}));
}

TEST_CASE("SYNC consumer: remote frames are not SYNC") {
  SyncNode node(with_counter());
  node.start();
  node.rx("080#R");
  node.silent();
  CHECK(node.counters().Malformed == 1);
}

TEST_CASE("SYNC consumer: 1019h accepts 0 and 2 to 240; others are refused with 0609 0030h [Y5] [SYNC 05]") {
  SyncNode node;
  for (unsigned value = 0; value <= 255; ++value) {
    CAPTURE(value);
    const bool legal = value == 0 || (value >= 2 && value <= 240);
    CHECK(node.set(0x1019, 0, 1, value) == (legal ? 0U : 0x06090030U));
    CHECK(node.get(0x1019, 0) == (legal ? value : value == 1 ? 0 : 240));
  }
}

TEST_CASE("SYNC consumer: 1019h cannot be changed while 1006h is not 0: 0800 0022h [Y5] [SYNC 09]") {
  SyncTable table;
  table.cycle = 100000;
  table.counter = 10;
  SyncNode node(table);
  CHECK(node.set(0x1019, 0, 1, 20) == 0x08000022);
  CHECK(node.set(0x1019, 0, 1, 0) == 0x08000022);
  CHECK(node.set(0x1019, 0, 1, 10) == 0);
  CHECK(node.set(0x1019, 0, 1, 1) == 0x06090030);
  CHECK(node.set(0x1006, 0, 4, 0) == 0);
  CHECK(node.set(0x1019, 0, 1, 20) == 0);
}

TEST_CASE("SYNC consumer: wrong lengths of the objects are refused [D5]") {
  SyncNode node;
  CHECK(node.set(0x1005, 0, 2, 0x80) == 0x06070013);
  CHECK(node.set(0x1006, 0, 2, 100) == 0x06070013);
  CHECK(node.set(0x1007, 0, 1, 100) == 0x06070013);
  CHECK(node.set(0x1019, 0, 2, 10) == 0x06070012);
  CHECK(node.upload(0x1006, 0).size() == 4);
  CHECK(node.upload(0x1007, 0).size() == 4);
  CHECK(node.upload(0x1019, 0).size() == 1);
}

TEST_CASE("SYNC consumer: a change of 1019h takes effect at once [Y5] [Y7]") {
  SyncNode node(with_counter());
  node.start();
  CHECK(node.set(0x1019, 0, 1, 5) == 0);
  node.rx("080#01");
  node.tx({"181#11", "281#21"});
  CHECK(node.set(0x1019, 0, 1, 0) == 0);
  node.rx("080#");
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: a new window applies from the next SYNC; one beyond the range of the timer is refused [X4]") {
  SyncNode node(with_counter(), [](Setup& setup) { setup.rate(1000000000); });
  CHECK(node.set(0x1007, 0, 4, 5000000) == 0x06090030);
  CHECK(node.set(0x1006, 0, 4, 5000000) == 0x06090030);
  CHECK(node.set(0x1007, 0, 4, 4000000) == 0);
  CHECK(node.get(0x1007, 0) == 4000000);
  SyncNode other(with_counter());
  other.start();
  CHECK(other.set(0x1007, 0, 4, 10000) == 0);
  other.can.refuse_all();
  other.rx("080#");
  other.after(10ms);
  other.can.accept_all();
  other.loop();
  other.silent();
}

TEST_CASE("SYNC consumer: each SYNC restarts the window [X4]") {
  SyncTable table = with_counter();
  table.window = 10000;
  SyncNode node(table);
  node.start();
  node.rx("080#");
  node.frames();
  node.after(9ms);
  node.can.refuse_all();
  node.rx("080#");
  node.after(9ms);
  node.can.accept_all();
  node.loop();
  node.tx({"181#11", "281#21"});
}

TEST_CASE("SYNC consumer: an RPDO with the CAN-ID of SYNC receives the frame, too") {
  if (CO_RPDO_N == 0) {
    return;
  }
  SyncTable table = with_counter(10);
  table.rpdo[0].on(0x80, 255, {0x22010308});
  SyncNode node(table);
  node.start();
  node.rx("080#07");
  CHECK(node.u8[2] == 7);
  node.tx("181#11");
}

#endif

// Writes every CAN-ID to 1005h. [301:7.3.5, 7.5.2.5] [Y2] [Other 10]

#if USE_SYNC && CO_RPDO_N > 0

// Returns a table whose RPDO 201h is synchronous and maps u8[0]: its value changes at the next SYNC only, which shows
// whether a frame is processed as SYNC.
SyncTable with_rpdo() {
  SyncTable table;
  table.rpdo[0].on(0x201, 1, {0x22010108});
  return table;
}

// Writes 1005h as the application. Returns the abort code that SDO would get; 0: accepted.
std::uint32_t write_sync_id(SyncNode& node, std::uint32_t value) {
  CO_ERR err = CO_ERR_NONE;
  node.call([&] { err = CODictWrLong(&node->Dict, CO_DEV(0x1005, 0), value); });
  CHECK((err == CO_ERR_NONE || err == CO_ERR_OBJ_RANGE));
  return err == CO_ERR_NONE ? 0 : 0x06090030;
}

TEST_CASE("SYNC sweep: each 11-bit CAN-ID is refused if restricted and otherwise received as SYNC at once [Y2] [N7]") {
  if (CO_RESTRICTED_IDS != 0) {
    return;  // restricted CAN-IDs are configured as permitted
  }
  SyncNode node(with_rpdo());
  node.start();
  std::uint32_t current = 0x80;
  std::uint8_t value = 0;
  for (std::uint32_t id = 0; id <= 0x7FF; ++id) {
    CAPTURE(id);
    const bool is_permitted = !is_restricted(id);
    CHECK(write_sync_id(node, 0x80000000 | id) == (is_permitted || id == current ? 0U : 0x06090030U));
    CHECK(write_sync_id(node, id) == (is_permitted ? 0U : 0x06090030U));
    current = is_permitted ? id : current;
    CHECK(node.sync_id == current);
    if (!is_permitted || id == 0x201 || id == 0x601) {
      continue;  // 201h and 601h are those of the RPDO and the SDO server, too
    }
    node.rx(CO_IF_FRM{0x201, {++value}, 1});
    node.rx(CO_IF_FRM{id, {}, 0});
    CHECK(node.u8[0] == value);
    node.frames();
  }
}

TEST_CASE("SYNC sweep: restricted CAN-IDs are refused by SDO with 0609 0030h for any flags [Y2] [Other 10]") {
  if (CO_RESTRICTED_IDS != 0) {
    return;  // restricted CAN-IDs are configured as permitted
  }
  SyncNode node(with_rpdo());
  for (const std::uint32_t id :
       {0x000U, 0x001U, 0x07FU, 0x101U, 0x180U, 0x581U, 0x5FFU, 0x601U, 0x67FU, 0x6E0U, 0x6FFU, 0x701U, 0x7FFU}) {
    for (const std::uint32_t flags : {0U, 0x40000000U, 0x80000000U, 0xC0000000U}) {
      CAPTURE(id);
      CHECK(node.set(0x1005, 0, 4, flags | id) == 0x06090030);
    }
  }
  for (const std::uint32_t id : {0x080U, 0x100U, 0x181U, 0x580U, 0x600U, 0x680U, 0x6DFU, 0x700U}) {
    CAPTURE(id);
    CHECK(node.set(0x1005, 0, 4, id) == 0);
  }
}

TEST_CASE("SYNC sweep: bits 11 to 28 without bit 29 are refused [Y2]") {
  SyncNode node(with_rpdo());
  for (unsigned bit = 11; bit < 29; ++bit) {
    CAPTURE(bit);
    CHECK(node.set(0x1005, 0, 4, 0x80U | 1U << bit) == 0x06090030);
    CHECK(node.set(0x1005, 0, 4, 0x40000080U | 1U << bit) == 0x06090030);
  }
}

TEST_CASE("SYNC sweep: with bit 29 every single bit of a 29-bit CAN-ID works and no 11-bit frame is SYNC [Y1] [Y2]") {
  SyncNode node(with_rpdo());
  node.start();
  std::uint8_t value = 0;
  for (unsigned bit = 0; bit < 29; ++bit) {
    const std::uint32_t id = 0x1000U | 1U << bit;
    CAPTURE(id);
    CHECK(node.set(0x1005, 0, 4, 0x20000000U | id) == 0);
    const std::uint8_t before = node.u8[0];
    node.rx(CO_IF_FRM{0x201, {++value}, 1});
    if ((id & 0x7FFU) != 0 && (id & 0x7FFU) != 0x201) {
      node.rx(CO_IF_FRM{id & 0x7FFU, {}, 8});
      node.frames();
      CHECK(node.u8[0] == before);
    }
    node.rx(CO_IF_FRM{id | CO_IF_FRM_EXT, {}, 0});
    CHECK(node.u8[0] == value);
  }
}

TEST_CASE("SYNC sweep: the receive filter follows 1005h at once [N7]") {
  SyncNode node(with_rpdo());
  const auto filtered = [&](std::uint32_t id) {
    return std::find(node.can.filter.begin(), node.can.filter.end(), id) != node.can.filter.end();
  };
  CHECK(filtered(0x80));
  CHECK(node.set(0x1005, 0, 4, 0x123 + 0x100) == 0);
  CHECK(filtered(0x223));
  CHECK_FALSE(filtered(0x80));
  CHECK(node.set(0x1005, 0, 4, 0x20000080) == 0);
  CHECK(filtered(0x80 | CO_IF_FRM_EXT));
}

TEST_CASE("SYNC sweep: with an invalid CAN-ID in 1005h of the table the node runs without SYNC") {
  for (const std::uint32_t id : {0x00000000U, 0x00000800U, 0x1FFFFFFFU, 0x20000000U, 0x40000000U, 0xFFFFFFFFU}) {
    CAPTURE(id);
    SyncTable table = with_rpdo();
    table.sync_id = id;
    table.cycle = 10000;
    SyncNode node(table);
    node.start();
    node.rx("201#42");
    node.rx("080#");
    if (id != 0xFFFFFFFF) {  // FFFFFFFFh: producer of the valid 29-bit CAN-ID 1FFFFFFFh
      node.after(100ms);
      node.silent();
      CHECK(node.u8[0] == 0x11);
    }
    node.frames();
    for (const std::uint32_t filter : node.can.filter) {
      CHECK((filter & ~(CO_IF_FRM_ID | CO_IF_FRM_EXT)) == 0);
    }
  }
}

#endif

}  // namespace
