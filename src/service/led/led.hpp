// SPDX-License-Identifier: Apache-2.0
// Status LEDs. [CiA 303-3]
#pragma once

#include "base/part.hpp"

namespace co::led {

// Clears all faults; the services that have raised them start anew.
void init(CO_NODE& node);

void on_mode(CO_NODE& node);

// Updates the LEDs after a change of a condition.
void update(CO_NODE& node);

void report_can(CO_NODE& node, CO_CAN_EVENT what);

// Raise and resolve a fault. Faults are counted.
void change_fault(CO_NODE& node, event::Fault fault, event::Change change, uint32_t detail);

inline constexpr Part part =
    Part().init(init).mode(on_mode).change_fault(change_fault).can(report_can).lss_changed(update);

}  // namespace co::led
