// SPDX-License-Identifier: Apache-2.0
// 1400h:1 and 1800h:1 relative to the node-ID (flag N). [301:7.5.2.35, 7.5.2.37]
#include "support/pdo_fixture.hpp"

namespace {

using namespace test;

constexpr std::uint32_t abort_range = 0x06090030;

/// Returns a table with RPDO 0 on 200h + node-ID for 2201h:1, and TPDO 0 on 180h + node-ID for 2202h:1.
PdoTable relative() {
  PdoTable table;
  table.rpdo[0].on(0x200, 255, {0x22010108});
  table.tpdo[0].on(0x40000180, 254, {0x22020110});
  return table;
}

/// A node with node-ID 127, whose PDOs have COB-IDs relative to the node-ID. Its SDO server uses the CAN-IDs of node-ID
/// 1, which the fixture requires.
struct Relative : PdoNode {
  explicit Relative(PdoTable& memory)
      : PdoNode(memory, [&](Setup& setup) {
          setup.node_id(0x7F);
          setup.with({CO_KEY(0x1200, 1, CO_OBJ_D___R_), CO_TSDO_ID, 0x601});
          setup.with({CO_KEY(0x1200, 2, CO_OBJ_D___R_), CO_TSDO_ID, 0x581});
          setup.with({CO_KEY(0x1400, 1, CO_OBJ__N__RW), CO_TPDO_ID, &memory.rpdo[0].cob_id});
          setup.with({CO_KEY(0x1800, 1, CO_OBJ__N__RW), CO_TPDO_ID, &memory.tpdo[0].cob_id});
        }) {}
};

TEST_CASE("PDO COB-ID: a relative one works and is read with the node-ID added [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  node.rx("000#017F");
  CHECK(node.get(0x1400, 1) == 0x27F);
  CHECK(node.get(0x1800, 1) == 0x400001FF);
  node.rx("27F#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("1FF#1112");
}

TEST_CASE("PDO COB-ID: a CAN-ID below the node-ID does not change the flags [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  node.rx("000#017F");
  for (const std::uint32_t id : {0x80000000U, 0x80000001U, 0x8000007EU, 0xA0000000U, 0xE0000010U, 0xFFFFFFFFU}) {
    CAPTURE(id);
    CHECK(node.set(0x1400, 1, 4, id) == 0);
    CHECK(node.get(0x1400, 1) == id);
    CHECK(node.set(0x1800, 1, 4, id) == 0);
    CHECK(node.get(0x1800, 1) == id);
  }
  node.trigger(0);
  node.silent();
  CHECK(node.set(0x1400, 1, 4, 0x190) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000191) == 0);
  CHECK(node.get(0x1400, 1) == 0x190);
  node.rx("190#2A");
  CHECK(node.u8[0] == 0x2A);
  node.trigger(0);
  node.tx("191#1112");
  node.rx("000#827F");
  node.tx("77F#00");
  CHECK(node.get(0x1400, 1) == 0x190);
  CHECK(node.get(0x1800, 1) == 0x40000191);
}

TEST_CASE("PDO COB-ID: a relative one cannot be changed while the PDO exists [P2] [P3] [D56]") {
  PdoTable memory = relative();
  Relative node(memory);
  CHECK(node.set(0x1400, 1, 4, 0x200) == abort_range);
  CHECK(node.set(0x1400, 1, 4, 0x27F) == 0);
  CHECK(node.set(0x1800, 1, 4, 0x40000180) == abort_range);
  CHECK(node.set(0x1800, 1, 4, 0x400001FF) == 0);
  CHECK(memory.rpdo[0].cob_id == 0x200);
  CHECK(memory.tpdo[0].cob_id == 0x40000180);
}

}  // namespace
