// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer and consumer. [301:7.2.8.3.2.2]
#pragma once

#include "base/part.hpp"

namespace co::heartbeat {

// Producer: called when the NMT state has changed. Starts heartbeats at the boot-up message, with the period of 1017h;
// stops them in states without error control (Initialisation, CO_INVALID).
void on_mode(CO_NODE& node);

// Consumer: called when the NMT state has changed. Stops monitoring in states without error control. Monitoring is
// configured by the Init functions of the entries of 1016h. [301:7.5.2.19]
void on_mode_consumer(CO_NODE& node);

// Consumer: processes a heartbeat of the node that 1016h monitors at sub-index number + 1. Returns false if the frame
// is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part().mode(on_mode);

}  // namespace co::heartbeat

namespace co::heartbeat_consumer {

inline constexpr Part part = Part().frames(heartbeat::on_frame).mode(heartbeat::on_mode_consumer);

}  // namespace co::heartbeat_consumer
