// SPDX-License-Identifier: Apache-2.0
// Types of the communication profile: calls of the application with any length.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "support/fixture.hpp"

#if CO_RPDO_N > 0 && CO_TPDO_N > 0 && USE_SYNC && USE_EMCY && CO_HBCONS_N > 0

namespace {

using namespace test;

struct Communication {
  std::uint32_t sync_id = 0x80, sync_cycle = 0, sync_window = 0, startup = CO_NMT_STARTUP_STAY;
  std::uint32_t rpdo_id = 0x80000201, tpdo_id = 0x80000181, rpdo_map = 0, tpdo_map = 0;
  std::uint16_t inhibit = 0, event = 0, heartbeat = 0;
  std::uint8_t sync_counter = 0, behaviour = 0, rpdo_type = 255, tpdo_type = 255, start = 0, rpdo_number = 0;
  std::uint8_t tpdo_number = 0;
  CO_HBCONS consumer{};
};

struct Row {
  std::uint16_t index;
  std::uint8_t sub;
  const CO_OBJ_TYPE* type;
  CO_DATA data;
  std::uint8_t width;
};

std::vector<Row> rows(Communication& c) {
  return {
      {0x1005, 0, CO_TSYNC_ID, CO_DATA(&c.sync_id), 4},
      {0x1006, 0, CO_TSYNC_CYCLE, CO_DATA(&c.sync_cycle), 4},
      {0x1007, 0, CO_TSYNC_WINDOW, CO_DATA(&c.sync_window), 4},
      {0x1016, 1, CO_THB_CONS, CO_DATA(&c.consumer), 4},
      {0x1017, 0, CO_THB_PROD, CO_DATA(&c.heartbeat), 2},
      {0x1019, 0, CO_TSYNC_COUNT, CO_DATA(&c.sync_counter), 1},
      {0x1029, 1, CO_TERROR_BEHAVIOUR, CO_DATA(&c.behaviour), 1},
      {0x1400, 1, CO_TPDO_ID, CO_DATA(&c.rpdo_id), 4},
      {0x1400, 2, CO_TPDO_TYPE, CO_DATA(&c.rpdo_type), 1},
      {0x1600, 0, CO_TPDO_NUM, CO_DATA(&c.rpdo_number), 1},
      {0x1600, 1, CO_TPDO_MAP, CO_DATA(&c.rpdo_map), 4},
      {0x1800, 1, CO_TPDO_ID, CO_DATA(&c.tpdo_id), 4},
      {0x1800, 2, CO_TPDO_TYPE, CO_DATA(&c.tpdo_type), 1},
      {0x1800, 3, CO_TPDO_INHIBIT, CO_DATA(&c.inhibit), 2},
      {0x1800, 5, CO_TPDO_EVENT, CO_DATA(&c.event), 2},
      {0x1800, 6, CO_TPDO_START, CO_DATA(&c.start), 1},
      {0x1A00, 0, CO_TPDO_NUM, CO_DATA(&c.tpdo_number), 1},
      {0x1A00, 1, CO_TPDO_MAP, CO_DATA(&c.tpdo_map), 4},
      {0x1F80, 0, CO_TNMT_STARTUP, CO_DATA(&c.startup), 4},
  };
}

Setup setup_of(const std::vector<Row>& rows) {
  Setup setup;
  setup.only_small();
  for (const Row& row : rows) {
    setup.with({CO_KEY(row.index, row.sub, CO_OBJ_____RW), row.type, row.data});
  }
  return setup;
}

TEST_CASE("types of communication objects: values of another length are neither read nor written") {
  Communication objects;
  const std::vector<Row> all = rows(objects);
  Fixture node(setup_of(all));
  for (const Row& row : all) {
    CAPTURE(row.index);
    CAPTURE(unsigned{row.sub});
    CO_OBJ* const obj = CODictFind(&node->Dict, CO_DEV(row.index, row.sub));
    REQUIRE(obj != nullptr);
    for (std::uint8_t width = 1; width <= 8; ++width) {
      if (width == row.width) continue;
      CAPTURE(unsigned{width});
      std::uint8_t value[8] = {1, 2, 3, 4, 5, 6, 7, 8};
      CO_ERR written = CO_ERR_NONE;
      CO_ERR read = CO_ERR_NONE;
      node.call([&] {
        written = COObjWrValue(obj, &node.node, value, width);
        read = COObjRdValue(obj, &node.node, value, width);
      });
      CHECK(written != CO_ERR_NONE);
      CHECK(read != CO_ERR_NONE);
      CHECK(value[0] == 1);
    }
  }
  CHECK(objects.sync_id == 0x80);
  CHECK(objects.startup == CO_NMT_STARTUP_STAY);
  CHECK(objects.rpdo_id == 0x80000201);
  CHECK(objects.tpdo_id == 0x80000181);
  CHECK(objects.rpdo_type == 255);
  CHECK(objects.tpdo_type == 255);
  CHECK((objects.sync_cycle | objects.sync_window | objects.rpdo_map | objects.tpdo_map) == 0);
  CHECK((objects.inhibit | objects.event | objects.heartbeat) == 0);
  CHECK((objects.sync_counter | objects.behaviour | objects.start | objects.rpdo_number | objects.tpdo_number) == 0);
  CHECK(objects.consumer.NodeId == 0);
}

}  // namespace

#endif
