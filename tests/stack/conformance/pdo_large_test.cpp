// SPDX-License-Identifier: Apache-2.0
// 512 RPDOs and 512 TPDOs in one node. (Only in the configuration with these numbers.)
#include "support/sync_fixture.hpp"

#if CO_RPDO_N == 512 && CO_TPDO_N == 512 && USE_SYNC

namespace {

using namespace test;

constexpr unsigned all = 512;

// A node whose RPDO n and TPDO n map variable n, at index 3000h + n / 128. Even PDOs are event-driven, odd ones
// synchronous.
class LargeNode : public SyncEntries {
 public:
  LargeNode() : fixture_(setup()) {
    fixture_.frames_per_call(1 + all);
    for (unsigned n = 0; n < all; ++n) fixture_.may_change(index_of(n), sub_of(n));
    fixture_.rx("000#0101");
    fixture_.silent();
  }

  static CO_IF_FRM rpdo(unsigned n, std::uint16_t value) { return frame(0x10000 + n, value); }
  static CO_IF_FRM tpdo(unsigned n, std::uint16_t value) { return frame(0x20000 + n, value); }

  Fixture* operator->() { return &fixture_; }
  std::uint16_t variable[all];
  std::uint32_t rpdo_id[all], rpdo_map[all], tpdo_id[all], tpdo_map[all];
  std::uint8_t type[all];
  std::uint16_t event[all] = {};

 private:
  static std::uint16_t index_of(unsigned n) { return static_cast<std::uint16_t>(0x3000 + n / 128); }
  static std::uint8_t sub_of(unsigned n) { return static_cast<std::uint8_t>(1 + n % 128); }

  static CO_IF_FRM frame(std::uint32_t id, std::uint16_t value) {
    return {id | CO_IF_FRM_EXT, {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)}, 2};
  }

  Setup setup() {
    Setup setup;
    setup.only_small().tx_queue(1000);
    add_to(setup);
    for (unsigned n = 0; n < all; ++n) add_pair(setup, n);
    return setup;
  }

  void add_pair(Setup& setup, unsigned n) {
    variable[n] = static_cast<std::uint16_t>(n);
    type[n] = n % 2 == 0 ? 255 : 1;
    rpdo_id[n] = 0x20010000 + n;
    tpdo_id[n] = 0x60020000 + n;
    rpdo_map[n] = tpdo_map[n] = std::uint32_t{index_of(n)} << 16 | std::uint32_t{sub_of(n)} << 8 | 16;
    setup.with({CO_KEY(index_of(n), sub_of(n), CO_OBJ____PRW), CO_TUNSIGNED16, CO_DATA(&variable[n])});
    add_pdo(setup, 0x1400 + n, rpdo_id[n], rpdo_map[n], n);
    add_pdo(setup, 0x1800 + n, tpdo_id[n], tpdo_map[n], n);
    setup.with({CO_KEY(0x1800 + n, 5, CO_OBJ_____RW), CO_TPDO_EVENT, CO_DATA(&event[n])});
  }

  void add_pdo(Setup& setup, unsigned index, std::uint32_t& id, std::uint32_t& map, unsigned n) {
    setup.with({CO_KEY(index, 1, CO_OBJ_____RW), CO_TPDO_ID, CO_DATA(&id)});
    setup.with({CO_KEY(index, 2, CO_OBJ_____RW), CO_TPDO_TYPE, CO_DATA(&type[n])});
    setup.with({CO_KEY(index + 0x200, 0, CO_OBJ_D___R_), CO_TPDO_NUM, 1});
    setup.with({CO_KEY(index + 0x200, 1, CO_OBJ_____RW), CO_TPDO_MAP, CO_DATA(&map)});
  }

  Fixture fixture_;
};

TEST_CASE("large: each of 512 RPDOs writes its object and no other one") {
  LargeNode node;
  for (unsigned n = 0; n < all; ++n) {
    const auto value = static_cast<std::uint16_t>(0x8000 + n);
    node->rx(LargeNode::rpdo(n, value));
    CHECK(node.variable[n] == (n % 2 == 0 ? value : n));
  }
  node->rx("080#");
  node->frames();
  for (unsigned n = 0; n < all; ++n) CHECK(node.variable[n] == 0x8000 + n);
  CHECK(node->counters().Unclaimed == 0);
}

TEST_CASE("large: each of 512 TPDOs is sent on a trigger; one SYNC sends all synchronous ones in order") {
  LargeNode node;
  for (unsigned n = 0; n < all; n += 2) {
    node->call([&] { CHECK(COTPdoRequest(&node->node, static_cast<std::uint16_t>(n)) == CO_ERR_NONE); });
    node->tx(notation(LargeNode::tpdo(n, static_cast<std::uint16_t>(n))));
  }
  node->rx("080#");
  std::vector<std::string> expected;
  for (unsigned n = 1; n < all; n += 2) {
    expected.push_back(notation(LargeNode::tpdo(n, static_cast<std::uint16_t>(n))));
  }
  CHECK(node->frames() == expected);
}

TEST_CASE("large: 256 event timers run at once without a lost period") {
  LargeNode node;
  for (unsigned n = 0; n < all; ++n) node.event[n] = 10;
  node->rx("000#8201");
  node->tx("701#00");
  node->rx("000#0101");
  CHECK(node->armed_timers() == all / 2);
  for (int i = 0; i < 10; ++i) {
    node->after(10ms);
    CHECK(node->frames().size() == all / 2);
  }
}

TEST_CASE(
    "large: the last PDOs are switched off and on by SDO; an unrelated frame among 1024 CAN-IDs is not consumed") {
  LargeNode node;
  node->ask("601#23FF1501FF010180", "581#60FF150100000000");
  node->rx(LargeNode::rpdo(511, 0x1234));
  node->rx("080#");
  node->frames();
  CHECK(node.variable[511] == 511);
  node->ask("601#23FF1501FF010120", "581#60FF150100000000");
  node->rx(LargeNode::rpdo(511, 0x1234));
  node->rx("080#");
  node->frames();
  CHECK(node.variable[511] == 0x1234);
  const std::uint32_t before = node->counters().Unclaimed;
  node->rx(LargeNode::rpdo(512, 0));
  node->rx("00010200#0000");
  CHECK(node->counters().Unclaimed == before + 2);
}

TEST_CASE("large: all 1024 PDOs end at a stop and start again at a start") {
  LargeNode node;
  node->rx("000#0201");
  node->rx(LargeNode::rpdo(0, 7));
  CHECK(node.variable[0] == 0);
  node->rx("000#0101");
  node->rx(LargeNode::rpdo(510, 7));
  CHECK(node.variable[510] == 7);
  node->rx("080#");
  CHECK(node->frames().size() == all / 2);
}

}  // namespace

#endif
