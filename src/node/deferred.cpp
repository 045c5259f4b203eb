// SPDX-License-Identifier: Apache-2.0
// Deferred work: requests that are executed where the outermost call ends.
#include "base/error.hpp"
#include "hal/port.hpp"
#include "node/mode.hpp"
#include "node/node.hpp"
#include "node/parts.hpp"

namespace co {

// Runs the deferred work whose bits are set in what, and the work that it causes. New parameters are not configured
// before a reset, which configures everything, nor in a node that is being stopped.
void node::run_pending(CO_NODE& node, unsigned what) {
  while (node.State == event::running) {
    const unsigned pending = event::runnable(node, what);
    if (pending == 0) {
      return;
    }
    const event::Working working(node);
    // send_deferred() and enter_requested_mode() remove the bits of messages and mode themselves.
    event::remove(node, pending & ~unsigned{event::messages | event::mode});
    if ((pending & event::configure) != 0 && (pending & event::resets) == 0 && node.Nmt.Next != CO_INVALID) {
      parts::run<&Part::of_configure>(node);
      routes::publish(node);
    }
    event::send_deferred(node);
    if ((pending & event::mode) != 0) {
      event::enter_requested_mode(node);
    }
    if ((pending & event::resets) != 0 && node.Nmt.Mode != CO_INVALID) {
      nmt::run_reset(node, static_cast<uint8_t>(pending));
    }
  }
  if (node.State == 0) {  // stopped
    node.Pending = 0;
  }
}

void event::run_all_deferred(CO_NODE& node) {
  node::run_pending(node, port::has_mainline(node) ? ~unsigned{of_mainline} : ~0U);
}

void event::end_call(CO_NODE& node, uint8_t before) {
  node.State &= static_cast<uint8_t>(before | ~working);
  run_deferred(node);
}

void event::send_deferred(CO_NODE& node) { parts::send_deferred(node); }

}  // namespace co
