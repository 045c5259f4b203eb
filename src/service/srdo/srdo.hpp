// SPDX-License-Identifier: Apache-2.0
// Safety-relevant data objects. [EN 50325-5]
#pragma once

#include "base/part.hpp"

namespace co::srdo {

// Sets the states of all SRDOs. No SRDO runs until Operational is entered.
void init(CO_NODE& node);

// Checks and starts the SRDOs when Operational is entered, and stops them when it is left.
void on_mode(CO_NODE& node);

// Processes a frame. number: twice the number of the SRDO, plus 1 for the inverse frame
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// End the running SRDOs with CO_SRDO_ERR_INTERNAL after CODictInit() has replaced the dictionary, which was checked:
// halt() before any function of the application may run, report_halted() with the callbacks.
void halt(CO_NODE& node);
void report_halted(CO_NODE& node);

inline constexpr Part part = Part().init(init).frames(on_frame).mode(on_mode).halt(halt).configure(report_halted);

}  // namespace co::srdo
