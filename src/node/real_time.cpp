// SPDX-License-Identifier: Apache-2.0
// A second thread for SYNC, PDOs, SRDOs and GFC: CONodeRealTime().
#include "base/error.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "hal/port.hpp"
#include "node/node.hpp"
#include "node/parts.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if USE_REAL_TIME

namespace co::node {
namespace {

// Returns whether all routes of the identifier at this slot need the permission of SYNC or PDOs: those of SYNC, PDOs,
// multiplex PDOs, SRDOs and GFC.
bool is_real_time(const CO_NODE& node, unsigned slot) {
  constexpr unsigned own = CO_SYNC_ALLOWED | CO_PDO_ALLOWED;
  const uint32_t id = node.Routes.Id[slot];
  while (routes::is_at(node, slot, id) && (parts::permission_of(node.Routes.Owner[slot]) & own) != 0) {
    ++slot;
  }
  return !routes::is_at(node, slot, id);
}

// Processes a frame in the real-time thread. A frame that the NMT state forbids now is dropped:
// CONodeProcess() would process it after newer frames.
void process(CO_NODE& node, const CO_IF_FRM& frame, unsigned slot) {
  if (slot == routes::nowhere || !parts::dispatch(node, frame, slot)) {
    count(node.Count.Unclaimed);
  }
}

// Queues a frame for CONodeProcess(); a frame that the ring cannot hold is lost and reported as overrun.
void queue_for_mainline(CO_NODE& node, const CO_IF_FRM& frame) {
  if (!CORingPut(node.Ext->Mainline, &frame)) {
    event::defer(node, event::overrun);
  }
}

// Returns whether a frame is processed by CONodeProcess(). slot: its first route
bool is_for_mainline(const CO_NODE& node, unsigned slot) {
  return slot == routes::nowhere ? node.Ext->Foreign : !is_real_time(node, slot);
}

// Processes a received frame, or queues it for CONodeProcess().
void process_or_queue(CO_NODE& node, CO_IF_FRM frame) {
  if (!check_length(node, frame)) {
    return;
  }
  if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
    queue_for_mainline(node, frame);
    return;
  }
  frame.Identifier = wire::normalised(frame.Identifier);
  const unsigned slot = routes::find(node, frame.Identifier & ~CO_IF_FRM_RTR);
  is_for_mainline(node, slot) ? queue_for_mainline(node, frame) : process(node, frame, slot);
}

}  // namespace

// Runs all deferred work in CONodeProcess(), with the work that only the mainline runs.
void run_deferred_of_mainline(CO_NODE& node) {
  if ((node.Pending & event::overrun) != 0) {
    const event::Working working(node);
    event::remove(node, event::overrun);
    report(node, CO_CAN_OVERRUN);
  }
  run_pending(node, ~unsigned{event::overrun});
}

// Returns whether deferred work or frames are queued for CONodeProcess().
bool is_awaited(const CO_NODE& node) {
  return port::has_mainline(node) && (node.Pending != 0 || CORingCount(node.Ext->Mainline) != 0);
}

bool receive_from_mainline(CO_NODE& node, CO_IF_FRM& frame) { return CORingGet(node.Ext->Mainline, &frame); }

}  // namespace co::node

// Keeps the node working throughout, so that the mainline runs the deferred work, except messages (EMCY, TPDOs). A
// requested NMT state ends the loop, and is entered at the end.
extern "C" void CONodeRealTime(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  const co::port::NodeLock lock(*node);
  if (!co::port::has_mainline(*node)) {
    return;
  }
  (void)COTmrService(&node->Tmr);
  if ((node->State & co::event::running) == 0) {
    co::node::drop_received(*node);
    return;
  }
  const unsigned ends =
      node->State == co::event::running
          ? unsigned{co::event::mode}
          : 0U;  // else the node works, without the lock while a memory is busy: the mainline enters the state
  {
    const co::event::Working working(*node);
    co::transmit::flush(*node);
    CO_IF_FRM frame = co::wire::empty_frame();
    while ((node->Pending & ends) == 0 && co::receive::read(*node, frame) > 0) {
      co::count(node->Count.Received);
      co::node::process_or_queue(*node, frame);
      co::event::send_deferred(*node);
    }
    co::tmr::run_real_time(node->Tmr);
  }
  co::node::run_pending(*node, co::event::mode);
}

#endif
