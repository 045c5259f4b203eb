// SPDX-License-Identifier: Apache-2.0
// The loop of the application: received frames, frames that wait for the controller, timers.
#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "hal/port.hpp"
#include "node/node.hpp"
#include "node/parts.hpp"
#include "wire/can_error.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

namespace co::node {
namespace {

bool waits_to_send(const CO_NODE& node) { return transmit::is_waiting(node) || node.Transmit.Paused != 0; }

// Offers frames that the driver has refused to the driver again, then continues block transfers and multiplex PDOs.
void resume_sending(CO_NODE& node) {
  transmit::flush(node);
  if ((USE_SDO_BLOCK != 0 || CO_MPDO_N != 0) && node.Transmit.Paused != 0) {
    const event::Working working(node);
    parts::on_free(node);
  }
}

// Calls resume_sending(), for CONodeProcess() and for COTmrProcess(), so that a firmware may call the former for
// received frames only. Where there is a real-time thread, resets are left to CONodeProcess().
[[gnu::noinline]] void resume_sending_between_frames(CO_NODE& node) {
  if (node.State != event::running) {
    return;
  }
  node.Transmit.Burst = 0;
  if (waits_to_send(node)) {
    resume_sending(node);
    event::run_deferred(node);
  }
}

void report_error_frame(CO_NODE& node, CO_IF_FRM& frame) {
  if (!port::can_report(node, frame)) {
    count(node.Count.Unclaimed);
  }
}

void dispatch(CO_NODE& node, CO_IF_FRM& frame) {
  if (frame.Identifier > wire::base_ids || frame.DLC > sizeof frame.Data) {
    if (!check_length(node, frame)) {
      return;
    }
    if ((frame.Identifier & CO_IF_FRM_ERROR) != 0) {
      report_error_frame(node, frame);
      return;
    }
    frame.Identifier = wire::normalised(frame.Identifier);
  }
#if CO_ROUTES_SORTED
  const unsigned slot = routes::find(node, frame.Identifier & ~CO_IF_FRM_RTR);
  const bool is_claimed = slot != routes::nowhere && parts::dispatch(node, frame, slot);
#else
  const bool is_claimed = parts::dispatch(node, frame);
#endif
  if (is_claimed) {
    return;
  }
  count(node.Count.Unclaimed);
  if (event::is_allowed(node, CO_NMT_ALLOWED)) {
    callback::receive_frame(node, frame);
  }
}

// Reads the next frame for CONodeProcess(): from the driver or, where there is a real-time thread, from the ring that
// it fills. Returns false if there is none.
bool receive(CO_NODE& node, CO_IF_FRM& frame) {
  if (port::has_mainline(node)) {
    return receive_from_mainline(node, frame);
  }
  if (receive::read(node, frame) <= 0) {
    return false;
  }
  count(node.Count.Received);
  return true;
}

}  // namespace

void report(CO_NODE& node, CO_CAN_EVENT event) {
  count(node.Count.CanEvents[event]);
  event::report_can(node, event);
  callback::change_can(node, event);
}

}  // namespace co::node

extern "C" {

void CONodeProcess(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  const co::port::NodeLock lock(*node);
  if constexpr (USE_REAL_TIME != 0) {
    co::node::run_deferred_of_mainline(*node);
  }
  if (node->State != co::event::running) {
    co::node::drop_received(*node);
    return;
  }
  if (co::node::waits_to_send(*node)) {
    co::node::resume_sending_between_frames(*node);
    if constexpr (USE_REAL_TIME != 0) {
      co::node::run_deferred_of_mainline(*node);
    }
    if (node->State != co::event::running) {
      return;
    }
  } else {
    node->Transmit.Burst = 0;  // the limit of offer() begins anew
  }
  CO_IF_FRM frame = co::wire::empty_frame();
  if (!co::node::receive(*node, frame)) {
    return;
  }
  node->State |= co::event::working;
  co::node::dispatch(*node, frame);
  node->State &= static_cast<uint8_t>(~co::event::working);
  co::node::run_deferred_of_mainline(*node);
}

void COTmrProcess(CO_TMR* tmr) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(tmr->Node);
  if (co::tmr::run_locked(*tmr, co::node::resume_sending_between_frames)) {
    return;
  }
  CO_NODE& node = *tmr->Node;
  // Like waits_to_send(), without a branch; resume_sending_between_frames() tests again.
  const bool waits = USE_FAST_PATHS == 0 || (node.TxQueue.Num | node.Transmit.Paused) != 0;
  if (waits) {
    co::node::resume_sending_between_frames(node);
  }
  if (!co::tmr::has_due(*tmr) || co::event::is_working(node)) {
    return;
  }
  if (!waits && node.State == co::event::running) {
    node.Transmit.Burst = 0;  // the limit of offer() begins anew
  }
  co::tmr::run_due(*tmr);
}

uint32_t CONodeNextDeadline(CO_NODE* node) {
  ASSERT_PTR_FATAL_ERR(node, UINT32_MAX);
  const co::port::NodeLock lock(*node);
  if (!co::port::is_initialised(*node)) {
    return UINT32_MAX;
  }
  if (co::node::is_awaited(*node)) {
    return 0;
  }
  const uint32_t timers = co::tmr::next_deadline(*node);
  if (!co::node::waits_to_send(*node)) {
    return timers;
  }
  if (co::transmit::is_paced(*node)) {
    return 0;
  }
  const uint32_t retry = co::tmr::ticks(*node, 1, CO_TMR_UNIT_1MS);
  return retry < timers ? retry : timers;
}

void CONodeCanEvent(CO_NODE* node, CO_CAN_EVENT event) {
  ASSERT_PTR_FATAL(node);
  if (event < CO_CAN_EVENT_NUM && co::port::is_initialised(*node)) {
    const co::event::Call call(*node);
    co::node::report(*node, event);
  }
}

// Decodes error frames. Only programs whose CAN driver names it (CO_IF_CAN_DRV_EX.Report) link it.
void CONodeCanReport(void*, CO_NODE* node, const CO_IF_FRM* frm) {
  ASSERT_PTR_FATAL(node);
  ASSERT_PTR_FATAL(frm);
  if ((frm->Identifier & CO_IF_FRM_ERROR) == 0) {
    return;
  }
  for (uint8_t event = 0; event < CO_CAN_EVENT_NUM; ++event) {
    if (co::wire::reports(*frm, static_cast<CO_CAN_EVENT>(event))) {
      CONodeCanEvent(node, static_cast<CO_CAN_EVENT>(event));
    }
  }
}

CO_NODE_COUNTERS CONodeGetCounters(const CO_NODE* node) { return node == nullptr ? CO_NODE_COUNTERS{} : node->Count; }

void* CONodeGetUser(const CO_NODE* node) { return node == nullptr || node->Ext == nullptr ? nullptr : node->Ext->User; }

}  // extern "C"
