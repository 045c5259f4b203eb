// SPDX-License-Identifier: Apache-2.0
// What services tell the rest of the node. They do not know one another: the table of node/services.cpp passes it on.
#pragma once

#include "co_core.h"

namespace co::event {

// May the node communicate so? what: CO_…_ALLOWED
[[nodiscard]] inline bool is_allowed(const CO_NODE& node, uint8_t what) { return (node.Nmt.Allowed & what) != 0; }

// Changes the NMT state: the application's callback, the permissions, then every service.
void change_mode(CO_NODE& node, CO_MODE mode);

// Things that wait until the frame being processed has been answered (CO_NODE.Pending); done at once if none is.
enum Pending : uint8_t {
  reset_node = 0x01,
  reset_communication = 0x02,
  commanded = 0x04,  // the reset was commanded by the NMT master
  configure_sdo = 0x08,
};
void defer(CO_NODE& node, uint8_t what);

// A reset asked for while the node is being initialised or started is part of that.
inline void forget_resets(CO_NODE& node) { node.Pending &= configure_sdo; }

// Does what waits, unless a frame is being processed or the mode is being changed.
void settle(CO_NODE& node);

}  // namespace co::event
