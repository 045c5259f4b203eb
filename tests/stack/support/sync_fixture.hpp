// SPDX-License-Identifier: Apache-2.0
/// \file sync_fixture.hpp
/// The node of pdo_fixture.hpp, with variables for the SYNC objects:
///
///     SyncTable table;                  // 1005h 80h, 1006h, 1007h and 1019h 0; all PDOs off
///     table.counter = 10;               // 1019h
///     table.rpdo[0].on(0x201, 1, {0x22010108});
///     SyncNode node(table);
///     node.start();  node.rx("080#01");
#pragma once

#include "pdo_fixture.hpp"

namespace test {

struct SyncEntries {
  std::uint32_t sync_id = 0x80;  ///< 1005h
  std::uint32_t cycle = 0;       ///< 1006h, µs
  std::uint32_t window = 0;      ///< 1007h, µs
  std::uint8_t counter = 0;      ///< 1019h

  void add_to([[maybe_unused]] Setup& setup) {
#if USE_SYNC
    setup.with({CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, CO_DATA(&sync_id)});
    setup.with({CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, CO_DATA(&cycle)});
    setup.with({CO_KEY(0x1007, 0, CO_OBJ_____RW), CO_TSYNC_WINDOW, CO_DATA(&window)});
    setup.with({CO_KEY(0x1019, 0, CO_OBJ_____RW), CO_TSYNC_COUNT, CO_DATA(&counter)});
#endif
  }
};

struct SyncTable : PdoTable, SyncEntries {};

class SyncNode : public SyncEntries, public PdoNode {
 public:
  explicit SyncNode(const SyncTable& table = {}, const std::function<void(Setup&)>& change = {})
      : SyncEntries(table), PdoNode(table, [&](Setup& setup) {
          add_to(setup);
          if (change) {
            change(setup);
          }
        }) {}
};

/// Returns an EMCY message of node 1 that the stack raises: code, error register (generic and communication), and the
/// number of the PDO, from 1, or another detail. [301:7.2.7.1]
inline std::string emcy(std::uint16_t code, std::uint8_t detail = 0) {
  CO_IF_FRM frm{0x81, {}, 8};
  CO_SET_WORD(&frm, code, 0);
  CO_SET_BYTE(&frm, code == 0 ? 0x00 : 0x11, 2);
  CO_SET_BYTE(&frm, detail, 5);
  return notation(frm);
}

/// Returns the EMCY messages if the node has EMCY, else none.
inline std::vector<std::string> reports([[maybe_unused]] std::initializer_list<std::string> all) {
  return USE_EMCY != 0 ? std::vector<std::string>(all) : std::vector<std::string>{};
}

}  // namespace test
