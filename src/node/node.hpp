// SPDX-License-Identifier: Apache-2.0
// Functions that the files of this folder share.
#pragma once

#include "base/error.hpp"
#include "base/events.hpp"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

namespace co::node {

// Sets adapters of classic drivers for the drivers that a node lacks.
using AddDrivers = void (*)(CO_IF& cif, CO_IF_DRV* drivers);

// Initialises a node. ext: null if the node has no drivers; add_drivers: null if all drivers have a context argument
void init(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext, AddDrivers add_drivers);

// Runs the part of the initialisation that every NMT reset repeats, in CO_INIT. The caller keeps the node working, so
// that requests of type functions and callbacks are deferred. Returns false if one of them requests another state.
[[nodiscard]] bool initialise(CO_NODE& node, CO_NMT_RESET type);

// Runs the deferred work whose bits are set in what, and the work that it causes.
void run_pending(CO_NODE& node, unsigned what);

// Counts and reports an event of the CAN controller.
void report(CO_NODE& node, CO_CAN_EVENT event);

// Returns false, and counts the frame as malformed, if its DLC is above 15.
[[nodiscard]] inline bool check_length(CO_NODE& node, CO_IF_FRM& frame) {
  const bool is_valid = wire::normalise_length(frame);
  if (!is_valid) {
    count(node.Count.Malformed);
  }
  return is_valid;
}

// Reads and drops a received frame in CO_INVALID, so that a loop that processes frames until there is none ends. The
// error that has stopped the node is kept: errors of the driver are not reported. A node that was never initialised has
// no drivers.
inline void drop_received(CO_NODE& node) {
  if (!port::is_initialised(node) || node.State != 0) {
    return;
  }
  CO_IF_FRM frame = wire::empty_frame();
  if (port::can_read(node, frame) > 0) {
    count(node.Count.Received);
    count(node.Count.Unclaimed);
  }
}

// A second thread for SYNC and PDOs (CONodeRealTime()): work and frames that it has left to CONodeProcess().
#if USE_REAL_TIME
void run_deferred_of_mainline(CO_NODE& node);
[[nodiscard]] bool is_awaited(const CO_NODE& node);
[[nodiscard]] bool receive_from_mainline(CO_NODE& node, CO_IF_FRM& frame);
#else
inline void run_deferred_of_mainline(CO_NODE& node) { event::run_deferred(node); }
[[nodiscard]] inline bool is_awaited(const CO_NODE&) { return false; }
[[nodiscard]] inline bool receive_from_mainline(CO_NODE&, CO_IF_FRM&) { return false; }
#endif

}  // namespace co::node
