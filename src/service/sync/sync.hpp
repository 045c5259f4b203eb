// SPDX-License-Identifier: Apache-2.0
// SYNC consumer and producer. [301:7.2.5]
#pragma once

#include "co_core.h"

namespace co::sync {

// Takes 1005h, 1006h, 1007h and 1019h from the dictionary.
void init(CO_NODE& node);

// A producer produces where SYNC is allowed, and counts anew where it was not. [301:7.2.5.1]
void on_mode(CO_NODE& node);

// False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

}  // namespace co::sync
