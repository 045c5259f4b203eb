// SPDX-License-Identifier: Apache-2.0
// TPDOs. [301:7.2.2.5.2-3]
#include <stddef.h>

#include "base/bits.hpp"
#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/pdo/configuration.hpp"
#include "service/pdo/mapping.hpp"
#include "service/pdo/multiplex.hpp"
#include "service/pdo/pdo.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if CO_TPDO_N > 0

namespace co::pdo {
namespace {

static_assert(offsetof(CO_TPDO, Own) % sizeof(Word) == 0);

// Returns whether remote requests are answered with the sample of the last SYNC.
bool keeps_sample(const CO_TPDO& pdo) { return USE_PDO_RTR != 0 && has(pdo.Map, remote) && is_synchronous(pdo.Type); }

// Calls the callback of the application, queues the frame and marks the PDO as sent.
CO_ERR send(CO_TPDO& pdo, CO_IF_FRM& frame) {
  callback::transmit_pdo(*pdo.Node, frame);
  if (!transmit::send_process_data(*pdo.Node, frame)) {
    return CO_ERR_IF_CAN_SEND;
  }
  mark_transferred(pdo.Map);
  return CO_ERR_NONE;
}

// Action of sample_or_send().
enum class Use : uint8_t {
  sample,       // reads the objects and stores them as the answer to remote requests, until the next SYNC
  send,         // reads the objects and sends them
  send_sampled  // sends the stored sample
};

// Reads the mapped objects, stores the sample and sends the frame, as use requires.
CO_ERR sample_or_send(CO_TPDO& pdo, Use use) {
  CO_IF_FRM frame = wire::empty_frame(pdo.Identifier, length_of(pdo.Map));
  if (use == Use::send_sampled) {
    copy_data(frame.Data, pdo.Own.Data);
  } else if (const CO_ERR err = copy_objects(*pdo.Node, pdo.Map, frame, Direction::transmit); err != CO_ERR_NONE) {
    return err;
  } else if (keeps_sample(pdo)) {
    copy_data(pdo.Own.Data, frame.Data);
    set(pdo.Map, sampled);
  }
  return use == Use::sample ? CO_ERR_NONE : send(pdo, frame);
}

void on_time(void* pdo_pointer);

void start(CO_TPDO& pdo, uint32_t ticks) { tmr::start(*pdo.Node, pdo.Tmr, ticks, 0, on_time, &pdo); }

// Restarts the inhibit or event time after a transmission. An inhibit time never starts before the transmission.
[[gnu::always_inline]] inline void restart_by(CO_TPDO& pdo, Cause cause) {
  const CO_TPDO_TIMES& time = pdo.Own.Time;
  if (time.Inhibit != 0) {
    set(pdo.Map, inhibited);
    start(pdo, time.Inhibit);
  } else if (time.Event == 0) {
    return;
  } else if (cause == Cause::timer) {
    tmr::restart(*pdo.Node, pdo.Tmr, time.Event);
  } else {
    start(pdo, time.Event);
  }
}

// Returns whether the event time is over at the end of the inhibit time; both start with a transmission.
bool is_over(const CO_TPDO_TIMES& time) { return time.Event != 0 && time.Event <= time.Inhibit; }

// Ends the inhibit time: sends the PDO if an event was deferred or the event time has elapsed, else runs the rest of
// the event time.
void end_inhibit(CO_TPDO& pdo) {
  const CO_TPDO_TIMES& time = pdo.Own.Time;
  clear(pdo.Map, inhibited);
  if (has(pdo.Map, pending) || is_over(time)) {
    if (is_over(time)) {
      mpdo::mark_all(pdo);
    }
    (void)send_event(pdo, Cause::timer);
  } else if (time.Event != 0) {
    tmr::restart(*pdo.Node, pdo.Tmr, time.Event - time.Inhibit);
  }
}

void on_time(void* pdo_pointer) {
  CO_TPDO& pdo = *static_cast<CO_TPDO*>(pdo_pointer);
  if (has(pdo.Map, inhibited)) {
    end_inhibit(pdo);
  } else {
    mpdo::mark_all(pdo);
    (void)send_event(pdo, Cause::timer);
  }
}

// Marks a PDO for send_marked(). A PDO that is sent for another reason loses its flag, but stays in the set.
void mark(CO_TPDO& pdo) {
  CO_NODE& node = *pdo.Node;
  set(pdo.Map, marked);
  bits::add(node.PdoSets.Marked, pdo.Number);
  event::defer(node, event::send_tpdos);
}

// Returns why an event of the application cannot trigger a PDO. Destination address mode is sent by COTPdoSendTo()
// only.
CO_ERR check_event(const CO_TPDO& pdo) {
  if (!is_operational(*pdo.Node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!exists(pdo.Map)) {
    return CO_ERR_TPDO_COM_OBJ;
  }
  const bool is_triggered = is_acyclic(pdo.Type) || (is_event_driven(pdo.Type) && !mpdo::is_dam(pdo.Map));
  return is_triggered ? CO_ERR_NONE : CO_ERR_TPDO_EVENT;
}

// Returns whether the PDO has to be sent because of an event. Otherwise the event is pending: an event-driven PDO is
// sent when the inhibit time has elapsed, an acyclic one at the next SYNC. [301:7.2.2.6]
bool is_sent_at_once(CO_TPDO& pdo) {
  if (is_event_driven(pdo.Type) && !has(pdo.Map, inhibited)) {
    return true;
  }
  set(pdo.Map, pending);
  return false;
}

// Triggers a PDO by an event of the application: sends it or leaves the event pending.
CO_ERR trigger(CO_TPDO& pdo) {
  const CO_ERR err = check_event(pdo);
  return err == CO_ERR_NONE && is_sent_at_once(pdo) ? send_event(pdo, Cause::event) : err;
}

// Like trigger(), but marks the PDO instead of sending it; while OdLock is held, in any case.
CO_ERR trigger_later(CO_TPDO& pdo) {
  const bool is_locked = pdo.Node->OdLocked != 0;
  const CO_ERR err = is_locked ? CO_ERR_NONE : check_event(pdo);
  if (is_locked || (err == CO_ERR_NONE && is_sent_at_once(pdo))) {
    mark(pdo);
  }
  return err;
}

bool has_counter([[maybe_unused]] const CO_NODE& node) {
#if USE_SYNC
  return node.Sync.Overflow != 0;
#else
  return false;
#endif
}

// Returns whether the PDO ignores this SYNC: it has a start value, and the SYNC has a wrong length or comes before the
// one with that value.
bool ignores(const CO_TPDO& pdo, uint8_t counter) {
  if (!has_counter(*pdo.Node)) {
    return false;
  }
  return counter == 0 ? start_value(*pdo.Node, pdo.Number) != 0 : has(pdo.Map, waiting) && counter != pdo.Count;
}

// Counts a SYNC. Returns whether the PDO is sent with it. The SYNC with the start value counts as the first one.
// [301:7.5.2.37]
bool count_sync(CO_TPDO& pdo, uint8_t counter) {
  if (ignores(pdo, counter)) {
    return false;
  }
  if (has(pdo.Map, waiting)) {
    clear(pdo.Map, waiting);
    pdo.Count = 0;
  }
  if (pdo.Type == type_acyclic) {
    const bool was_pending = has(pdo.Map, pending);
    clear(pdo.Map, pending);
    return was_pending;
  }
  if (pdo.Type > last_synchronous_type || ++pdo.Count < pdo.Type) {
    return false;
  }
  pdo.Count = 0;
  return true;
}

// Processes a SYNC. Changes of mapped objects by their Read functions trigger no further transmission of this PDO.
void process_sync(CO_TPDO& pdo, uint8_t counter) {
  clear(pdo.Map, sampled);
  const bool is_due = count_sync(pdo, counter);
  if (!is_due && !keeps_sample(pdo)) {
    return;
  }
  const CO_ERR err = sample_or_send(pdo, is_due ? Use::send : Use::sample);
  clear(pdo.Map, marked);
  if (is_due && err != CO_ERR_NONE && pdo.Type == type_acyclic) {
    set(pdo.Map, pending);
  }
}

// Returns whether the PDO maps this entry. In a scanner list the object is also marked as pending.
bool maps_or_marks(CO_TPDO& pdo, uint16_t entry) {
  return mpdo::is_sam(pdo.Map) ? mpdo::mark(*pdo.Node, entry) : maps(pdo.Map, entry);
}

// Triggers the marked PDOs, in the order of their numbers. Those that are marked meanwhile are left to the next round.
// Returns the last error.
CO_ERR trigger_marked(CO_NODE& node) {
  CO_ERR last = CO_ERR_NONE;
  event::remove(node, event::send_tpdos);
  bits::take_each(node.PdoSets.Marked, [&](unsigned n) {
    CO_TPDO& pdo = node.TPdo[n];
    if (has(pdo.Map, marked)) {
      clear(pdo.Map, marked);
      const CO_ERR err = trigger(pdo);
      last = err != CO_ERR_NONE ? err : last;
    }
  });
  return last;
}

// Starts a PDO: when Operational is entered, or when the PDO is configured in Operational.
void begin(CO_TPDO& pdo) {
  constexpr auto lasting = static_cast<uint8_t>(remote | transferred | changed);
  if (!exists(pdo.Map)) {
    return;
  }
  pdo.Map.Flags &= lasting;
  mpdo::clear_marks(pdo);
  if (is_event_driven(pdo.Type)) {
    if (CO_TPDO_ON_START != 0) {
      mpdo::mark_all(pdo);
      (void)trigger_later(pdo);
    } else if (pdo.Own.Time.Event != 0) {
      start(pdo, pdo.Own.Time.Event);
    }
  } else if (USE_SYNC != 0) {
    pdo.Count = start_value(*pdo.Node, pdo.Number);
    set(pdo.Map, (pdo.Count != 0 ? waiting : 0) | (pdo.Type == type_acyclic ? pending : 0));
  }
}

void withdraw_synchronous(CO_NODE& node) {
  bits::for_each(node.PdoSets.Sync, [&](unsigned n) { transmit::withdraw(node, node.TPdo[n].Identifier); });
}

}  // namespace

CO_ERR send_event(CO_TPDO& pdo, Cause cause) {
  set(pdo.Map, inhibited);
  const CO_ERR err = mpdo::is_sam(pdo.Map) ? mpdo::send_pending(pdo) : sample_or_send(pdo, Use::send);
  clear(pdo.Map, inhibited | pending | marked);
  if (mpdo::is_pending(pdo)) {
    set(pdo.Map, pending);
  }
  restart_by(pdo, cause);
  return err;
}

void restart(CO_TPDO& pdo) { restart_by(pdo, Cause::event); }

void end_tpdo(CO_NODE& node, CO_PDO& pdo) {
  tmr::stop(node, pdo.Tmr);
  transmit::withdraw(node, pdo.Identifier);
}

void begin_tpdo(CO_PDO& pdo, uint32_t identifier, Remote requests) {
  CO_NODE& node = *pdo.Node;
  const bool asked = USE_PDO_RTR != 0 && requests == Remote::answered && exists(pdo.Map) && !mpdo::is_mpdo(pdo.Map);
  pdo.Identifier = identifier;
  pdo.Map.Flags = static_cast<uint8_t>((pdo.Map.Flags & changed) | (asked ? unsigned{remote} : 0U));
  mpdo::begin_tpdo(pdo, pdo.Number);
  if (USE_SYNC != 0) {
    exists(pdo.Map) && is_synchronous(pdo.Type) ? bits::add(node.PdoSets.Sync, pdo.Number)
                                                : bits::remove(node.PdoSets.Sync, pdo.Number);
  }
  if (USE_PDO_RTR != 0) {
    routes::change(node, asked ? identifier : wire::no_frame, routes::owner<PartId::tpdo>(pdo.Number));
  }
  if (is_operational(node)) {
    begin(pdo);
  }
}

void change_event_time(CO_NODE& node, unsigned number, uint32_t ticks) {
  CO_ASSERT(number < CO_TPDO_N);
  CO_TPDO& pdo = node.TPdo[number];
  if (!exists(pdo.Map) || !is_event_driven(pdo.Type) || mpdo::is_dam(pdo.Map)) {
    return;
  }
  pdo.Own.Time.Event = ticks;
  if (has(pdo.Map, inhibited) || !is_operational(node)) {
    return;
  }
  tmr::stop(node, pdo.Tmr);
  if (ticks != 0) {
    start(pdo, ticks);
  }
}

void on_mode_tpdos(CO_NODE& node) {
  const bool operational = is_operational(node);
  for (CO_TPDO& pdo : node.TPdo) {
    operational ? begin(pdo) : end_tpdo(node, pdo);
  }
}

// Answers a remote request. [301:7.2.2.5.3]
bool on_remote(CO_NODE& node, const CO_IF_FRM&, uint16_t number) {
  CO_ASSERT(number < CO_TPDO_N && exists(node.TPdo[number].Map));
  CO_TPDO& pdo = node.TPdo[number];
  if (USE_PDO_RTR == 0) {
    return false;
  }
  if (is_event_driven(pdo.Type)) {
    if (is_sent_at_once(pdo)) {
      (void)send_event(pdo, Cause::event);
    }
  } else if (pdo.Type == type_rtr || has(pdo.Map, sampled)) {
    (void)sample_or_send(pdo, pdo.Type == type_rtr ? Use::send : Use::send_sampled);
    clear(pdo.Map, marked);
  }
  return true;
}

void sample(CO_NODE& node, uint8_t counter) {
  if (is_operational(node)) {
    bits::for_each(node.PdoSets.Sync, [&](unsigned n) { process_sync(node.TPdo[n], counter); });
  }
}

void flush(CO_NODE& node) {
  if (USE_SYNC != 0) {
    withdraw_synchronous(node);
  }
}

CO_ERR change_object(CO_NODE& node, const CO_OBJ& obj) {
  const uint16_t entry = number_of(node, obj);
  CO_ERR all = CO_ERR_TPDO_OBJ_TRIGGER;
  for (CO_TPDO& pdo : node.TPdo) {
    if (maps_or_marks(pdo, entry)) {
      const CO_ERR err = trigger_later(pdo);
      all = err != CO_ERR_NONE || all == CO_ERR_TPDO_OBJ_TRIGGER ? err : all;
    }
  }
  return all;
}

// Changes by Read functions and callbacks of the PDOs are sent in a second round; changes in that round wait for the
// next event.
CO_ERR send_marked(CO_NODE& node) {
  CO_ASSERT(node.OdLocked == 0 && event::is_working(node));
  const CO_ERR err = trigger_marked(node);
  if (!bits::is_empty(node.PdoSets.Marked)) {
    (void)trigger_marked(node);
    event::remove(node, event::send_tpdos);
  }
  return err;
}

CO_ERR request(CO_NODE& node, uint16_t number) {
  CO_ASSERT(number < CO_TPDO_N);
  return node.OdLocked == 0 ? trigger(node.TPdo[number]) : trigger_later(node.TPdo[number]);
}

CO_ERR request_object(CO_NODE& node, const CO_OBJ& obj) {
  const CO_ERR err = change_object(node, obj);
  const bool is_sent = node.OdLocked == 0 && (node.Pending & event::send_tpdos) != 0;
  const CO_ERR sent = is_sent ? send_marked(node) : CO_ERR_NONE;
  return err != CO_ERR_NONE ? err : sent;
}

event::Outlet find_outlet(CO_NODE& node, const CO_OBJ& obj) {
  using event::Outlet;
  const uint16_t entry = number_of(node, obj);
  Outlet outlet = Outlet::none;
  for (CO_TPDO& pdo : node.TPdo) {
    if (exists(pdo.Map) && maps(pdo.Map, entry) && outlet != Outlet::queued) {
      outlet = transmit::is_queued(node, pdo.Identifier) ? Outlet::queued : Outlet::open;
    }
  }
  if (outlet != Outlet::open || !is_operational(node)) {
    return outlet == Outlet::open ? Outlet::closed : outlet;
  }
  return transmit::has_room_for_application(node) ? Outlet::open : Outlet::full;
}

bool was_sent(CO_NODE& node, uint16_t number) {
  CO_ASSERT(number < CO_TPDO_N);
  return take_transferred(node.TPdo[number].Map);
}

bool was_sent(CO_NODE& node, const CO_OBJ& obj) {
  const uint16_t entry = number_of(node, obj);
  bool was = false;
  for (CO_TPDO& pdo : node.TPdo) {
    was |= take_transferred(pdo.Map, entry);
  }
  return mpdo::was_sent(node, entry) || was;
}

}  // namespace co::pdo

#else  // functions for configurations without them

namespace co::pdo {

void end_tpdo(CO_NODE&, CO_PDO&) {}
void begin_tpdo(CO_PDO&, uint32_t, Remote) {}
void change_event_time(CO_NODE&, unsigned, uint32_t) {}
CO_ERR request(CO_NODE&, uint16_t) { return CO_ERR_TPDO_NUM_TRIGGER; }
CO_ERR request_object(CO_NODE&, const CO_OBJ&) { return CO_ERR_TPDO_OBJ_TRIGGER; }
bool was_sent(CO_NODE&, uint16_t) { return false; }
bool was_sent(CO_NODE&, const CO_OBJ&) { return false; }

}  // namespace co::pdo

#endif
