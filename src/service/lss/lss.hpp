// SPDX-License-Identifier: Apache-2.0
// LSS slave. [305]
#pragma once

#include "co_core.h"

namespace co::lss {

// Initialises node-ID and bit rate: the stored values, otherwise those that the application has given.
void begin(CO_NODE& node);

// Load node-ID and bit rate as pending values (load()), and make the pending node-ID the node's, at a reset
// (take_node_id()).
void load(CO_NODE& node);
void take_node_id(CO_NODE& node);

// Returns whether the started node has to wait for a node-ID.
[[nodiscard]] bool awaits_node_id(CO_NODE& node);

void init(CO_NODE& node);
void on_mode(CO_NODE& node);
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

}  // namespace co::lss
