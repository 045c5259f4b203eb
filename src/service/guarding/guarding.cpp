// SPDX-License-Identifier: Apache-2.0
#include "service/guarding/guarding.hpp"

#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "wire/cob_id.hpp"
#include "wire/nmt.hpp"

#if USE_GUARDING

namespace co::guarding {
namespace {

// Returns the life time in ticks; 0: no life guarding. [301:7.5.2.11, 7.5.2.12]
uint32_t life_time(CO_NODE& node) {
  const uint32_t guard_time = dict::read_number(node, CO_DEV(0x100C, 0), sizeof(uint16_t), 0);  // ms
  const uint32_t factor = dict::read_number(node, CO_DEV(0x100D, 0), sizeof(uint8_t), 0);
  return tmr::ticks(node, guard_time * factor, CO_TMR_UNIT_1MS);
}

// Returns whether a heartbeat is produced, which replaces guarding. [301:7.2.8.2.2.1]
bool is_replaced_by_heartbeat(const CO_NODE& node) { return tmr::is_running(node.HbProdTmr); }

// Called when the life time has elapsed without a remote request: reports the loss of the NMT master.
void lose_master(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  if (is_replaced_by_heartbeat(node)) {
    return;
  }
  node.Guarding.Lost = 1;
  event::raise(node, event::Fault::life_guard, 0);
  event::lose_communication(node);
  callback::guard_life(node, true);
}

// Called for each remote request: reports that a lost NMT master is present again.
void find_master(CO_NODE& node) {
  if (node.Guarding.Lost == 0) {
    return;
  }
  node.Guarding.Lost = 0;
  event::resolve(node, event::Fault::life_guard, 0);
  callback::guard_life(node, false);
}

// Starts the life time again; 0 ticks: stops life guarding.
void restart_life(CO_NODE& node, uint32_t ticks) {
  if (ticks == 0) {
    tmr::stop(node, node.Guarding.Tmr);
  } else {
    tmr::start(node, node.Guarding.Tmr, ticks, 0, lose_master, &node);
  }
}

// Responds to a remote request. A response that is still in the transmit queue is the response to this request, too,
// because the toggle bit must not skip a value on the bus.
void answer(CO_NODE& node) {
  CO_IF_FRM* const waiting = transmit::find_waiting(node, wire::CobId::error_control + node.NodeId);
  const uint8_t toggle = waiting != nullptr ? waiting->Data[0] & wire::guarding_toggle : node.Guarding.Toggle;
  const CO_IF_FRM frame = wire::error_control(node.NodeId, node.Nmt.Mode, toggle);
  if (waiting != nullptr) {
    *waiting = frame;
  } else if (transmit::send(node, frame)) {
    node.Guarding.Toggle ^= wire::guarding_toggle;
  }
}

}  // namespace

bool on_remote(CO_NODE& node, const CO_IF_FRM&, uint16_t) {
  const bool guarded = !is_replaced_by_heartbeat(node);
  if (guarded) {
    answer(node);
  }
  restart_life(node, guarded ? life_time(node) : 0);
  find_master(node);
  return true;
}

void on_mode(CO_NODE& node) {
  if (!event::is_allowed(node, CO_NMT_ALLOWED)) {
    tmr::stop(node, node.Guarding.Tmr);
  }
}

void reset(CO_NODE& node) {
  node.Guarding.Toggle = 0;
  node.Guarding.Lost = 0;
}

}  // namespace co::guarding

#endif

namespace co::guarding {

void init(CO_NODE& node) {
  routes::add(node, wire::CobId::error_control + node.NodeId, routes::owner<PartId::error_control>(0));
  if constexpr (USE_GUARDING != 0) {
    reset(node);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM&, uint16_t) {
  if (node.Error == CO_ERR_NONE) {  // the bus does not replace an error that was not read yet
    error::report(node, CO_ERR_NODE_ID_TWICE);
  }
  event::raise(node, event::Fault::collision, node.NodeId);
  return false;
}

}  // namespace co::guarding
