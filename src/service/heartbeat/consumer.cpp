// SPDX-License-Identifier: Apache-2.0
// Heartbeat consumer: 1016h. [301:7.2.8.3.2.2, 7.5.2.19] A heartbeat only stores its time. One timer for all consumers
// elapses when the first node may be missing, and then checks all of them.
#include "co_heartbeat.h"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/integer.hpp"
#include "hal/port.hpp"
#include "service/heartbeat/heartbeat.hpp"
#include "wire/nmt.hpp"

#if CO_HBCONS_N > 0

namespace co::heartbeat {
namespace {

// Values of CO_HBCONS.Tmr.
constexpr int16_t unheard = 0;  // no heartbeat since the entry was configured: the node is not monitored yet
constexpr int16_t in_time = 1;
constexpr int16_t missing = 2;  // the time has elapsed without a heartbeat

constexpr bool is_active(uint16_t ms, uint8_t node_id) { return ms != 0 && node_id >= 1 && node_id <= 127; }

// Returns whether a heartbeat was received since the entry was configured.
bool is_watching(const CO_HB_WATCH& watch) { return watch.Period != 0 && watch.Cons->Tmr != unheard; }

// Returns the entry that monitors a node.
CO_HB_WATCH* find(CO_NODE& node, uint8_t node_id) {
  for (CO_HB_WATCH& watch : node.HbCons) {
    if (watch.Period != 0 && watch.Cons->NodeId == node_id) {
      return &watch;
    }
  }
  return nullptr;
}

void check(void* node_pointer);

// Returns the ticks until the node is missing, at least 1.
uint32_t ticks_left(const CO_HB_WATCH& watch, uint32_t now) {
  const uint32_t passed = now - watch.Seen;
  return passed < watch.Period ? watch.Period - passed : 1;
}

// Starts the timer with the shortest of the remaining times.
void plan(CO_NODE& node) {
  const uint32_t now = tmr::now(node);
  uint32_t next = 0;  // ticks; 0: no node is monitored
  for (const CO_HB_WATCH& watch : node.HbCons) {
    const uint32_t left = is_watching(watch) ? ticks_left(watch, now) : next;
    next = next == 0 || left < next ? left : next;
  }
  if (next == 0) {
    tmr::stop(node, node.HbConsTmr);
  } else {
    tmr::start(node, node.HbConsTmr, next, 0, check, &node);
  }
}

// Counts a period without heartbeat and calls the application. The first one is a fault and causes the reaction of
// 1029h.
void miss(CO_NODE& node, CO_HBCONS& cons) {
  CO_ASSERT(is_active(cons.Time, cons.NodeId));
  const uint8_t node_id = cons.NodeId;
  cons.Event = static_cast<uint8_t>(cons.Event + (cons.Event < UINT8_MAX ? 1 : 0));
  if (cons.Tmr != missing) {
    cons.Tmr = missing;
    event::raise(node, event::Fault::heartbeat, node_id);
    event::lose_communication(node);
  }
  callback::miss_heartbeat(node, node_id);
}

// Checks all nodes. The timer is started only after all callbacks have returned, because they may change the entries.
void check(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  const uint32_t now = tmr::now(node);
  for (CO_HB_WATCH& watch : node.HbCons) {
    const uint32_t passed = now - watch.Seen;
    if (is_watching(watch) && passed >= watch.Period) {
      watch.Seen = now - passed % watch.Period;  // end of the last missed period
      miss(node, *watch.Cons);
    }
  }
  plan(node);
}

// Processes the first heartbeat, a state that is another one or reserved, or a boot-up message. CONmtHbConsChange() is
// called for changes of the state, and for each boot-up message.
void hear(CO_NODE& node, CO_HBCONS& cons, CO_MODE mode) {
  const int16_t before = cons.Tmr;
  if (before == in_time && mode == cons.State && mode != CO_INIT) {
    return;
  }
  cons.Tmr = in_time;
  if (before == unheard) {
    plan(node);
  } else if (before == missing) {
    event::resolve(node, event::Fault::heartbeat, cons.NodeId);
  }
  callback::change_heartbeat(node, cons.NodeId, mode);
  if (cons.Tmr == in_time) {  // the callback has not changed the entry
    cons.State = mode;
  }
}

// Stops monitoring. A node that was missing is no longer a fault, without an EMCY message.
void stop(CO_NODE& node, CO_HB_WATCH& watch) {
  if (is_watching(watch) && watch.Cons->Tmr == missing) {
    event::forget(node, event::Fault::heartbeat);
  }
  watch.Period = 0;
}

// Configures an entry: its node is monitored from its first heartbeat on. The caller updates timer and routes.
CO_ERR start(CO_NODE& node, CO_HB_WATCH& watch, uint16_t ms, uint8_t node_id) {
  const bool active = is_active(ms, node_id);
  const uint32_t period = active ? tmr::ticks(node, ms, CO_TMR_UNIT_1MS) : 0;
  const CO_HB_WATCH* const other = active ? find(node, node_id) : nullptr;
  if (other != nullptr && other != &watch) {
    return CO_ERR_OBJ_INCOMPATIBLE;
  }
  if (active && period == 0) {
    return CO_ERR_OBJ_RANGE;
  }
  stop(node, watch);
  watch.Period = period;
  *watch.Cons = {&node, nullptr, CO_INVALID, unheard, ms, node_id, 0};
  const auto number = static_cast<uint16_t>(&watch - node.HbCons);
  const uint32_t identifier = active ? wire::CobId::error_control + node_id : wire::no_frame;
  routes::change(node, identifier, routes::owner<PartId::heartbeat_consumer>(number));
  return CO_ERR_NONE;
}

// Changes an entry. Equal values have no effect, unless the entry is valid and its monitoring was stopped.
CO_ERR change(CO_NODE& node, CO_HB_WATCH& watch, uint16_t ms, uint8_t node_id) {
  const CO_HBCONS& cons = *watch.Cons;
  if (cons.Time == ms && cons.NodeId == node_id && is_active(ms, node_id) == (watch.Period != 0)) {
    return CO_ERR_NONE;
  }
  const CO_ERR err = start(node, watch, ms, node_id);
  if (err == CO_ERR_NONE) {
    plan(node);
    routes::publish(node);
  }
  return err;
}

CO_ERR change(CO_NODE& node, const CO_HBCONS& cons, uint16_t ms, uint8_t node_id) {
  for (CO_HB_WATCH& watch : node.HbCons) {
    if (watch.Cons == &cons) {
      return change(node, watch, ms, node_id);
    }
  }
  return CO_ERR_BAD_ARG;
}

// 1016h. Sub 0 is an UNSIGNED8, the others are UNSIGNED32: time in bits 0…15, node-ID in bits 16…23.

bool is_entry(const CO_OBJ& obj) { return CO_GET_SUB(obj.Key) != 0; }

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  if (!is_entry(*obj)) {
    return integer::Number<1>::size(obj, node, width);
  }
  return data_of<CO_HBCONS>(*obj) == nullptr ? 0 : sizeof(uint32_t);
}

CO_ERR init(CO_OBJ* obj, CO_NODE* node) {
  const bool entry = is_entry(*obj);
  const CO_ERR err = dict::check_type(*obj, *node, entry ? rules::heartbeat_consumer : rules::heartbeat_consumers);
  if (!entry || err != CO_ERR_NONE) {
    return err;
  }
  if (data_of<CO_HBCONS>(*obj) == nullptr || !dict::is_number(CO_GET_SUB(obj->Key) - 1U, CO_HBCONS_N)) {
    return CO_ERR_TYPE_INIT;
  }
  CO_HB_WATCH& watch = node->HbCons[CO_GET_SUB(obj->Key) - 1];
  CO_HBCONS& cons = *data_of<CO_HBCONS>(*obj);
  cons.Node = node;
  watch = {&cons, 0, 0};
  return start(*node, watch, cons.Time, cons.NodeId);
}

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (!is_entry(*obj)) {
    return integer::Number<1>::read(obj, node, buffer, size);
  }
  const CO_HBCONS* const cons = data_of<CO_HBCONS>(*obj);
  if (cons == nullptr || size != sizeof(uint32_t)) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t value = cons->Time | (uint32_t{cons->NodeId} << 16);
  integer::put_u32(buffer, value);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (!is_entry(*obj)) {
    return integer::Number<1>::write(obj, node, buffer, size);
  }
  const CO_HBCONS* const cons = data_of<CO_HBCONS>(*obj);
  if (cons == nullptr || size != sizeof(uint32_t)) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t value = integer::get_u32(buffer);
  return change(*node, *cons, static_cast<uint16_t>(value), static_cast<uint8_t>(value >> 16));
}

}  // namespace

void on_mode_consumer(CO_NODE& node) {
  if (event::is_allowed(node, CO_NMT_ALLOWED)) {
    return;
  }
  for (CO_HB_WATCH& watch : node.HbCons) {
    stop(node, watch);
  }
  tmr::stop(node, node.HbConsTmr);
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  if (frame.DLC != wire::error_control_dlc) {
    return false;
  }
  CO_ASSERT(number < CO_HBCONS_N);
  CO_HB_WATCH& watch = node.HbCons[number];
  CO_ASSERT(watch.Cons != nullptr && watch.Period != 0);
  const uint8_t state = wire::state_of(frame);
  watch.Seen = tmr::now(node);
  if (watch.Cons->Tmr != in_time || wire::heartbeat_states[watch.Cons->State] != state || state == 0) {
    hear(node, *watch.Cons, CONmtModeDecode(state));
  }
  return true;
}

}  // namespace co::heartbeat

extern "C" {

const CO_OBJ_TYPE COTNmtHbCons = {co::heartbeat::size, co::heartbeat::init, co::heartbeat::read, co::heartbeat::write,
                                  nullptr};

CO_ERR CONmtHbConsActivate(CO_HBCONS* hbc, uint16_t time, uint8_t nodeid) {
  ASSERT_PTR_ERR(hbc, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(hbc->Node, CO_ERR_BAD_ARG);
  CO_NODE& node = *hbc->Node;
  if (!co::port::is_initialised(node)) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(node);
  return co::heartbeat::change(node, *hbc, time, nodeid);
}

int16_t CONmtGetHbEvents(CO_NMT* nmt, uint8_t nodeId) {
  ASSERT_PTR_FATAL_ERR(nmt, -1);
  ASSERT_PTR_FATAL_ERR(nmt->Node, -1);
  const CO_HB_WATCH* const watch = co::heartbeat::find(*nmt->Node, nodeId);
  if (watch == nullptr) {
    return -1;
  }
  const uint8_t events = watch->Cons->Event;
  watch->Cons->Event = 0;
  return events;
}

CO_MODE CONmtLastHbState(CO_NMT* nmt, uint8_t nodeId) {
  ASSERT_PTR_FATAL_ERR(nmt, CO_INVALID);
  ASSERT_PTR_FATAL_ERR(nmt->Node, CO_INVALID);
  const CO_HB_WATCH* const watch = co::heartbeat::find(*nmt->Node, nodeId);
  return watch == nullptr ? CO_INVALID : watch->Cons->State;
}

}  // extern "C"

#endif
