// SPDX-License-Identifier: Apache-2.0
// Status LEDs. [CiA 303-3]
#pragma once

#include "base/events.hpp"

#if USE_LED

namespace co::led {

// Clears all faults; the services that have raised them start anew.
void init(CO_NODE& node);

void on_mode(CO_NODE& node);

// Updates the LEDs after a change of a condition.
void update(CO_NODE& node);

void report_can(CO_NODE& node, CO_CAN_EVENT what);

// Raise and resolve a fault. Faults are counted.
void raise(CO_NODE& node, event::Fault fault);
void resolve(CO_NODE& node, event::Fault fault);

}  // namespace co::led

#endif
