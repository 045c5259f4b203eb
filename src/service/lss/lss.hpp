// SPDX-License-Identifier: Apache-2.0
// LSS slave. [305]
#pragma once

#include "base/part.hpp"

namespace co::lss {

// Initialises node-ID and bit rate: the stored values, otherwise those that the application has given.
void begin(CO_NODE& node);

// Load node-ID and bit rate as pending values (load()), and make the pending node-ID the node's, at a reset
// (take_node_id()).
void load(CO_NODE& node);
void take_node_id(CO_NODE& node);

// Returns whether the started node has to wait for a node-ID.
[[nodiscard]] bool awaits_node_id(CO_NODE& node);

// Returns whether the node waits for a node-ID.
[[nodiscard]] bool is_waiting(const CO_NODE& node);

// Sets the node-ID that the application has chosen.
void change_node_id(CO_NODE& node, uint8_t id);

void init(CO_NODE& node);
void on_mode(CO_NODE& node);
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part()
                                 .begin(begin)
                                 .init(init)
                                 .frames(on_frame)
                                 .mode(on_mode)
                                 .reset_node(load)
                                 .reset(take_node_id)
                                 .node_id(change_node_id)
                                 .awaits_node_id(awaits_node_id)
                                 .is_waiting(is_waiting);

}  // namespace co::lss

// LSS master. [305]

namespace co::lss_master {

void init(CO_NODE& node);

// Ends the service in progress when the node is stopped or reset.
void on_mode(CO_NODE& node);

// Processes a response of a slave. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode);

}  // namespace co::lss_master
