// SPDX-License-Identifier: Apache-2.0
// Status LEDs. [CiA 303-3]
#pragma once

#include "core/events.hpp"

#if USE_LED

namespace co::led {

// Faults from before are forgotten; the services that have reported them begin anew.
void init(CO_NODE& node);

void on_mode(CO_NODE& node);

// Something that they show has changed.
void update(CO_NODE& node);

void report_can(CO_NODE& node, CO_CAN_EVENT what);

// A fault has come, or gone; each counts.
void raise(CO_NODE& node, event::Fault fault);
void resolve(CO_NODE& node, event::Fault fault);

}  // namespace co::led

#endif
