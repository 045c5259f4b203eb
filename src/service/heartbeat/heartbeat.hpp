// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer. [301:7.2.8.3.2.2]
#pragma once

#include "co_core.h"

namespace co::heartbeat {

void on_mode(CO_NODE& node);

}  // namespace co::heartbeat
