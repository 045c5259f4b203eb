// SPDX-License-Identifier: Apache-2.0
// TIME consumer and producer, and a running clock. [301:7.2.6]
#pragma once

#include "co_core.h"

#if USE_TIME

namespace co::time {

// What 1012h says holds from now on.
void init(CO_NODE& node);

// False: malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

void on_mode(CO_NODE& node);

// A message that waits for a bus that is gone is not to be sent later.
void flush(CO_NODE& node);

// Sets the clock and lets it run; the errors of COTimeSet().
[[nodiscard]] CO_ERR set_clock(CO_NODE& node, const CO_TIME_OF_DAY& time);

[[nodiscard]] bool is_set(const CO_NODE& node);

// 0 if it was not set yet.
[[nodiscard]] CO_TIME_OF_DAY read_clock(CO_NODE& node);

void stop_clock(CO_NODE& node);

}  // namespace co::time

#endif
