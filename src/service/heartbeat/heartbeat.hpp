// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer. [301:7.2.8.3.2.2]
#pragma once

#include "co_core.h"

namespace co::heartbeat {

void on_mode(CO_NODE& node);

// Consumer: nobody is monitored any more where error control is not allowed. [301:7.5.2.19] The entries of 1016h are
// taken by their type.
void on_mode_consumer(CO_NODE& node);

// The heartbeat of the node that 1016h names at sub-index number. False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

}  // namespace co::heartbeat
