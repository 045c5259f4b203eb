// SPDX-License-Identifier: Apache-2.0
/// \file pdo_commands.hpp
/// NMT requests that PDO callbacks send to the node, and checks of their results. For nodes with two RPDOs and two
/// TPDOs at least.
#pragma once

#include "sync_fixture.hpp"

#if CO_TPDO_N > 1 && CO_RPDO_N > 1

namespace test {

inline SyncTable table_of(std::uint8_t type) {
  SyncTable table;
  table.rpdo[0].on(0x201, type, {0x22010108});
  table.rpdo[1].on(0x301, type, {0x22010208});
  table.tpdo[0].on(0x40000181, type, {0x22010308});
  table.tpdo[1].on(0x40000281, type, {0x22010408});
  return table;
}

inline SyncTable asynchronous() { return table_of(255); }

inline void command(PdoNode& node, const std::string& what) {
  if (what == "reset communication") {
    CONmtReset(&node->Nmt, CO_RESET_COM);
  } else if (what == "reset node") {
    CONmtReset(&node->Nmt, CO_RESET_NODE);
  } else if (what == "pre-operational") {
    CONmtSetMode(&node->Nmt, CO_PREOP);
  } else if (what == "stopped") {
    CONmtSetMode(&node->Nmt, CO_STOP);
  } else {
    CONodeStop(&node.node);
  }
}

inline const std::string commands[] = {"reset communication", "reset node", "pre-operational", "stopped",
                                       "stop of the node"};

inline bool is_pdo(const std::string& text) {
  return text[0] >= '1' && text[0] <= '5' && text.compare(0, 3, "581") != 0;
}

inline unsigned pdos(const std::vector<std::string>& sent) {
  return static_cast<unsigned>(std::count_if(sent.begin(), sent.end(), is_pdo));
}

// Checks that the node sends no PDO after a callback's request and has no armed timer, and that it works after a start.
inline void check_left(PdoNode& node) {
  node.after(2000ms);
  CHECK(pdos(node.frames()) == 0);
  if (node.mode() == CO_INVALID) {
    CHECK(node.armed_timers() == 0);
    return;
  }
  CHECK(node.armed_timers() == 0);
  callbacks() = Callbacks{};
  node.rx("000#0101");
  node.rx("201#42");
  node.rx("080#");
  CHECK(node.u8[0] == 0x42);
  node.frames();
}

}  // namespace test

#endif
