// SPDX-License-Identifier: Apache-2.0
/// \file mpdo_fixture.hpp
/// The node of pdo_fixture.hpp with the lists of multiplex PDOs in variables, 1FA0h and 1FD0h with 4 and 1FA1h and
/// 1FD1h with 2 entries each:
///
///     MpdoTable table;                        // all PDOs off, the lists empty
///     table.rpdo[0].on(0x201, 255, {}).number = 0xFF;
///     table.scan[0] = 0x03220101;             // 1FA0h sub 1: 2201h, sub 1…3
///     MpdoNode node(table);
///     node.start();  node.rx("201#8101220142000000");
#pragma once

#include "sync_fixture.hpp"

#if CO_MPDO_N > 0

namespace test {

struct MpdoEntries {
  std::array<std::uint32_t, 6> scan{};
  std::array<std::uint64_t, 6> dispatch{};

  void add_to(Setup& setup) {
    for (unsigned n = 0; n < 6; ++n) {
      const auto list = static_cast<std::uint16_t>(n / 4);
      const auto sub = static_cast<std::uint8_t>(n % 4 + 1);
      setup.with({CO_KEY(0x1FA0 + list, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(list == 0 ? 4 : 2)});
      setup.with({CO_KEY(0x1FD0 + list, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, CO_DATA(list == 0 ? 4 : 2)});
      setup.with({CO_KEY(0x1FA0 + list, sub, CO_OBJ_____RW), CO_TPDO_SCAN, CO_DATA(&scan[n])});
      setup.with({CO_KEY(0x1FD0 + list, sub, CO_OBJ_____RW), CO_TPDO_DISPATCH, CO_DATA(&dispatch[n])});
    }
  }
};

struct MpdoTable : PdoTable, MpdoEntries {};

class MpdoNode : public MpdoEntries, public PdoNode {
 public:
  explicit MpdoNode(const MpdoTable& table = {}, const std::function<void(Setup&)>& change = {})
      : MpdoEntries(table), PdoNode(table, [&](Setup& setup) {
          add_to(setup);
          if (change) {
            change(setup);
          }
        }) {}

  CO_ERR send_to(std::uint16_t number, std::uint8_t node_id, std::uint32_t key, std::uint32_t value) {
    CO_ERR err = CO_ERR_NONE;
    call([&] { err = COTPdoSendTo(&node, number, node_id, key, value); });
    return err;
  }
  void trigger_object(std::uint16_t index, std::uint8_t sub) {
    call([&] { COTPdoTrigObj(node.TPdo, find(index, sub)); });
  }
};

constexpr std::uint8_t sam = 0xFE;
constexpr std::uint8_t dam = 0xFF;

}  // namespace test

#endif
