// SPDX-License-Identifier: Apache-2.0
// LSS master. [305]
#pragma once

#include "base/part.hpp"

namespace co::lss_master {

void init(CO_NODE& node);

// Ends the service in progress when the node is stopped or reset.
void on_mode(CO_NODE& node);

// Processes a response of a slave. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode);

}  // namespace co::lss_master
