// SPDX-License-Identifier: Apache-2.0
// Writes every CAN-ID to 1005h. [301:7.3.5, 7.5.2.5] [Y2] [Other 10]
#include "support/restricted_ids.hpp"
#include "support/sync_fixture.hpp"

#if USE_SYNC && CO_RPDO_N > 0

namespace {

using namespace test;

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

}  // namespace

#endif
