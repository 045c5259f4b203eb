// SPDX-License-Identifier: Apache-2.0
// Node guarding and life guarding of this node, and the route of its error control identifier (700h + node-ID).
// [301:7.2.8.2.2]
#pragma once

#include "base/part.hpp"

namespace co::guarding {

// Adds the route of the node's error control identifier, and calls reset().
void init(CO_NODE& node);

// Processes a data frame with the node's error control identifier: another node has the same node-ID. Reports
// CO_ERR_NODE_ID_TWICE and raises event::Fault::collision. Returns false, because this service has no use for the
// frame: it counts as malformed unless another service processes it. number: not used.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// With USE_GUARDING 0 these are not defined.

// Sets the toggle bit of the next response to 0, and clears the state of life guarding that the NMT master is missing.
void reset(CO_NODE& node);

// Processes a guarding request (remote frame) of the NMT master: responds, and restarts the life time. number: not
// used.
[[nodiscard]] bool on_remote(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

// Called when the NMT state has changed. Stops life guarding in states without error control (Initialisation,
// CO_INVALID).
void on_mode(CO_NODE& node);

}  // namespace co::guarding

namespace co::error_control {

constexpr Part part_without_guarding = Part().init(guarding::init).frames(guarding::on_frame);
inline constexpr Part part = USE_GUARDING != 0
                                 ? part_without_guarding.remote_frames(guarding::on_remote).mode(guarding::on_mode)
                                 : part_without_guarding;

}  // namespace co::error_control
