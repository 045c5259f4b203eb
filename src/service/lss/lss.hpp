// SPDX-License-Identifier: Apache-2.0
// LSS slave. [305]
#pragma once

#include "co_core.h"

namespace co::lss {

// The node is being initialised: node-ID and bit rate are those that were stored, else those that it has.
void begin(CO_NODE& node);

// What was stored becomes the node-ID of the next reset; this one becomes the node's.
void load(CO_NODE& node);
void take_node_id(CO_NODE& node);

// The node is started: does it have to wait for a node-ID?
[[nodiscard]] bool awaits_node_id(CO_NODE& node);

void init(CO_NODE& node);
void on_mode(CO_NODE& node);
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

}  // namespace co::lss
