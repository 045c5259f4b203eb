// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer. [301:7.2.8.3.2.2]
#pragma once

#include "co_core.h"

namespace co::heartbeat {

void on_mode(CO_NODE& node);

// Consumer: stops monitoring when error control is not allowed. [301:7.5.2.19] The Init functions of the types add the
// entries of 1016h.
void on_mode_consumer(CO_NODE& node);

// Processes the heartbeat of the node monitored by sub-index number of 1016h. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

}  // namespace co::heartbeat
