// SPDX-License-Identifier: Apache-2.0
// Node guarding and life guarding of this node; its own error control identifier. [301:7.2.8.2.2]
#pragma once

#include "co_core.h"

namespace co::guarding {

// Adds the route of the node's error control frames, and calls reset().
void init(CO_NODE& node);

// Reports that another node has sent an error control frame of this node.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

#if USE_GUARDING

// Sets the toggle bit to 0; the NMT master is not missing.
void reset(CO_NODE& node);

// Processes a guarding request of the NMT master.
[[nodiscard]] bool on_remote(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Stops life guarding when error control is not allowed.
void on_mode(CO_NODE& node);

#else

inline void reset(CO_NODE&) {}
[[nodiscard]] inline bool on_remote(CO_NODE&, const CO_IF_FRM&, uint16_t) { return false; }
inline void on_mode(CO_NODE&) {}

#endif

}  // namespace co::guarding
