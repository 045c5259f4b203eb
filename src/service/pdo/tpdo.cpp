// SPDX-License-Identifier: Apache-2.0
// TPDOs. [301:7.2.2.5.2-3]
#include "core/events.hpp"
#include "core/routes.hpp"
#include "core/timer.hpp"
#include "core/transmit.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/pdo.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if CO_TPDO_N > 0

namespace co::pdo {
namespace {

enum Flag : uint8_t {
  pending = 0x01,    // an event waits for the end of the inhibit time, or for the SYNC
  inhibited = 0x02,  // the timer runs for the inhibit time
  starts = 0x04,     // it has a SYNC start value
  waiting = 0x08,    // for that SYNC, whose number Count holds
  sampled = 0x10,    // Data holds what was sampled at the last SYNC
  sent = 0x20,       // since the application has asked
  touched = 0x40,    // an object has changed
  remote = 0x80,     // may be asked for
};

// Links of the list are numbers from 1.
constexpr uint16_t none = 0;
CO_TPDO& at(CO_NODE& node, uint16_t link) { return node.TPdo[link - 1]; }

bool has(const CO_TPDO& pdo, Flag flag) { return (pdo.Map.Flags & flag) != 0; }
void set(CO_TPDO& pdo, Flag flag) { pdo.Map.Flags = static_cast<uint8_t>(pdo.Map.Flags | flag); }
void clear(CO_TPDO& pdo, Flag flag) { pdo.Map.Flags = static_cast<uint8_t>(pdo.Map.Flags & ~flag); }

uint16_t number_of(const CO_TPDO& pdo) { return static_cast<uint16_t>(&pdo - pdo.Node->TPdo); }

bool exists(const CO_TPDO& pdo) { return pdo.Map.Num != 0; }
bool is_operational(const CO_NODE& node) { return event::is_allowed(node, CO_PDO_ALLOWED); }

// What Read functions change of the PDO itself is part of it.
CO_ERR fill(CO_TPDO& pdo, CO_IF_FRM& frame) {
  CO_NODE& node = *pdo.Node;
  const Lock lock(node);
  const CO_ERR err = read(node, pdo.Map, frame);
  clear(pdo, touched);
  if (err != CO_ERR_NONE) {
    node.Error = err;
  }
  return err;
}

// The application may have ended Operational meanwhile, or the PDO.
CO_ERR send(CO_TPDO& pdo, CO_IF_FRM& frame) {
  const uint32_t identifier = pdo.Identifier;
  COPdoTransmit(&frame);
  if (!is_operational(*pdo.Node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!exists(pdo) || pdo.Identifier != identifier) {
    return CO_ERR_TPDO_COM_OBJ;
  }
  if (!transmit::send_process_data(*pdo.Node, frame)) {
    return CO_ERR_IF_CAN_SEND;
  }
  set(pdo, sent);
  pass(pdo.Map);
  return CO_ERR_NONE;
}

// The objects as they are now.
CO_ERR send_now(CO_TPDO& pdo) {
  CO_IF_FRM frame = wire::empty_frame(pdo.Identifier, pdo.Map.Length);
  const CO_ERR err = fill(pdo, frame);
  return err == CO_ERR_NONE ? send(pdo, frame) : err;
}

void on_time(void* pdo_pointer);

// The times of an event-driven PDO begin with each transmission. The event time of one that the timer has asked for
// began when the timer elapsed, so that nothing drifts; an inhibit time never begins before the transmission. A
// callback may have started the timer.
void restart(CO_TPDO& pdo, bool by_timer) {
  CO_NODE& node = *pdo.Node;
  const uint32_t ticks = pdo.Inhibit != 0 ? pdo.Inhibit : pdo.Event;
  if (ticks == 0 || !exists(pdo) || !is_operational(node)) {
    return;
  }
  if (pdo.Inhibit != 0) {
    set(pdo, inhibited);
  }
  if (by_timer && pdo.Inhibit == 0 && !tmr::is_running(pdo.Tmr)) {
    tmr::again(node.Tmr, pdo.Tmr, ticks);
  } else {
    tmr::start(node.Tmr, pdo.Tmr, ticks, 0, on_time, &pdo);
  }
}

// What cannot be sent now is not sent later, but the event timer goes on. An event for the PDO that comes from its own
// callback is part of it.
CO_ERR send_event(CO_TPDO& pdo, bool by_timer) {
  set(pdo, inhibited);
  const CO_ERR err = send_now(pdo);
  clear(pdo, inhibited);
  clear(pdo, pending);
  restart(pdo, by_timer);
  return err;
}

void end_inhibit(CO_TPDO& pdo) {
  clear(pdo, inhibited);
  if (has(pdo, pending) || (pdo.Event != 0 && pdo.Event <= pdo.Inhibit)) {
    (void)send_event(pdo, true);
  } else if (pdo.Event != 0) {
    tmr::again(pdo.Node->Tmr, pdo.Tmr, pdo.Event - pdo.Inhibit);
  }
}

void on_time(void* pdo_pointer) {
  CO_TPDO& pdo = *static_cast<CO_TPDO*>(pdo_pointer);
  if (has(pdo, inhibited)) {
    end_inhibit(pdo);
  } else {
    (void)send_event(pdo, true);
  }
  settle_touched(*pdo.Node);
}

// An event inside the inhibit time is kept. [301:7.2.2.6]
CO_ERR take_event(CO_TPDO& pdo) {
  if (has(pdo, inhibited)) {
    set(pdo, pending);
    return CO_ERR_NONE;
  }
  return send_event(pdo, false);
}

CO_ERR trigger(CO_TPDO& pdo) {
  if (is_event_driven(pdo.Type)) {
    return take_event(pdo);
  }
  if (pdo.Type != type_acyclic) {
    return CO_ERR_TPDO_EVENT;
  }
  set(pdo, pending);
  return CO_ERR_NONE;
}

void send_touched(CO_TPDO& pdo) {
  if (has(pdo, touched)) {
    clear(pdo, touched);
    if (is_operational(*pdo.Node)) {
      (void)trigger(pdo);
    }
  }
}

// What remote requests are answered with until the next SYNC.
void keep(CO_TPDO& pdo) {
  CO_IF_FRM frame = wire::empty_frame(pdo.Identifier, pdo.Map.Length);
  clear(pdo, sampled);
  if (fill(pdo, frame) == CO_ERR_NONE) {
    __builtin_memcpy(pdo.Data, frame.Data, sizeof pdo.Data);
    set(pdo, sampled);
  }
}

CO_ERR send_kept(CO_TPDO& pdo) {
  CO_IF_FRM frame = wire::empty_frame(pdo.Identifier, pdo.Map.Length);
  __builtin_memcpy(frame.Data, pdo.Data, sizeof pdo.Data);
  return send(pdo, frame);
}

bool has_counter([[maybe_unused]] const CO_NODE& node) {
#if USE_SYNC
  return node.Sync.Overflow != 0;
#else
  return false;
#endif
}

// Is this the SYNC that it is sent with? The one with the start value counts as the first. [301:7.5.2.37]
bool counts(CO_TPDO& pdo, uint8_t counter) {
  if (has_counter(*pdo.Node) && has(pdo, starts) && (counter == 0 || (has(pdo, waiting) && counter != pdo.Count))) {
    return false;
  }
  if (has(pdo, waiting)) {
    clear(pdo, waiting);
    pdo.Count = 0;
  }
  if (pdo.Type == type_acyclic) {
    const bool was_pending = has(pdo, pending);
    clear(pdo, pending);
    return was_pending;
  }
  if (pdo.Type > last_synchronous_type || ++pdo.Count < pdo.Type) {
    return false;
  }
  pdo.Count = 0;
  return true;
}

void take_sync(CO_TPDO& pdo, uint8_t counter) {
  const bool is_due = counts(pdo, counter);
  if (USE_PDO_RTR != 0 && has(pdo, remote)) {
    keep(pdo);
  }
  if (!is_due) {
    return;
  }
  const CO_ERR err = has(pdo, sampled) ? send_kept(pdo) : send_now(pdo);
  if (err != CO_ERR_NONE && pdo.Type == type_acyclic) {
    set(pdo, pending);
  }
}

// The list of synchronous PDOs is in the order of their numbers.
uint16_t& find_link(CO_NODE& node, uint16_t to) {
  uint16_t* link = &node.TPdoFirst;
  while (*link != none && *link < to) {
    link = &at(node, *link).Next;
  }
  return *link;
}

void list(CO_NODE& node, uint16_t number, bool listed) {
  const auto own = static_cast<uint16_t>(number + 1);
  uint16_t& link = find_link(node, own);
  if (listed && link != own) {
    at(node, own).Next = link;
    link = own;
  } else if (!listed && link == own) {
    link = at(node, own).Next;
  }
}

// Enters Operational, or the PDO comes into being there.
void begin(CO_TPDO& pdo) {
  if (!exists(pdo)) {
    return;
  }
  constexpr auto lasting = static_cast<uint8_t>(remote | sent);
  pdo.Map.Flags &= lasting;
  pdo.Count = start_value(*pdo.Node, number_of(pdo));
  if (pdo.Count != 0) {
    set(pdo, starts);
    set(pdo, waiting);
  }
  if (pdo.Type == type_acyclic) {
    set(pdo, pending);
  }
  if (!is_event_driven(pdo.Type)) {
    return;
  }
  if (CO_TPDO_ON_START != 0) {
    (void)send_event(pdo, false);
  } else if (pdo.Event != 0) {
    tmr::start(pdo.Node->Tmr, pdo.Tmr, pdo.Event, 0, on_time, &pdo);
  }
}

void end(CO_NODE& node, CO_TPDO& pdo) {
  tmr::stop(node.Tmr, pdo.Tmr);
  clear(pdo, inhibited);
  clear(pdo, pending);
  if (exists(pdo)) {
    transmit::withdraw(node, pdo.Identifier);
  }
}

void withdraw_synchronous(CO_NODE& node) {
  for (uint16_t link = node.TPdoFirst; link != none && transmit::is_waiting(node); link = at(node, link).Next) {
    transmit::withdraw(node, at(node, link).Identifier);
  }
}

bool is_remote(const Parameters& parameters) {
  return USE_PDO_RTR != 0 && (parameters.cob_id & CO_TPDO_COBID_REMOTE) == 0;
}

}  // namespace

void configure_tpdo(CO_NODE& node, uint16_t number) {
  CO_TPDO& pdo = node.TPdo[number];
  Parameters parameters = {};
  end(node, pdo);
  configure(node, Direction::transmit, static_cast<uint16_t>(first_tpdo + number), parameters, pdo.Map);
  pdo.Identifier = wire::frame_id(parameters.cob_id);
  pdo.Inhibit = is_event_driven(parameters.type) ? parameters.inhibit : 0;
  pdo.Event = is_event_driven(parameters.type) ? parameters.event : 0;
  pdo.Type = parameters.type;
  const bool asked = exists(pdo) && is_remote(parameters);
  pdo.Map.Flags = asked ? remote : 0;
  list(node, number, exists(pdo) && is_synchronous(pdo.Type));
  if (USE_PDO_RTR != 0) {
    routes::change(node, asked ? pdo.Identifier : wire::no_frame, routes::Service::tpdo, number);
  }
  if (is_operational(node)) {
    begin(pdo);
  }
}

void change_event_time(CO_NODE& node, uint16_t number, uint32_t ticks) {
  CO_TPDO& pdo = node.TPdo[number];
  if (!exists(pdo) || !is_event_driven(pdo.Type)) {
    return;
  }
  pdo.Event = ticks;
  if (has(pdo, inhibited) || !is_operational(node)) {
    return;
  }
  tmr::stop(node.Tmr, pdo.Tmr);
  if (ticks != 0) {
    tmr::start(node.Tmr, pdo.Tmr, ticks, 0, on_time, &pdo);
  }
}

void init_tpdos(CO_NODE& node) {
  node.TPdoFirst = none;
  node.WindowOver = 0;
  node.Touched = 0;
  for (uint16_t number = 0; number < CO_TPDO_N; ++number) {
    node.TPdo[number].Node = &node;
    configure_tpdo(node, number);
  }
}

void on_mode_tpdos(CO_NODE& node) {
  const bool operational = is_operational(node);
  for (CO_TPDO& pdo : node.TPdo) {
    operational ? begin(pdo) : end(node, pdo);
  }
  settle_touched(node);
}

// [301:7.2.2.5.3]
bool on_remote(CO_NODE& node, uint16_t number) {
  CO_TPDO& pdo = node.TPdo[number];
  if (is_event_driven(pdo.Type)) {
    (void)take_event(pdo);
  } else if (pdo.Type == type_rtr) {
    (void)send_now(pdo);
  } else if (has(pdo, sampled)) {
    (void)send_kept(pdo);
  }
  settle_touched(node);
  return true;
}

void sample(CO_NODE& node, uint8_t counter) {
  node.WindowOver = 0;
  if (!is_operational(node)) {
    return;
  }
  for (uint16_t link = node.TPdoFirst; link != none && is_operational(node); link = at(node, link).Next) {
    take_sync(at(node, link), counter);
  }
  settle_touched(node);
}

void end_window(CO_NODE& node) {
  node.WindowOver = 1;
  withdraw_synchronous(node);
}

void flush(CO_NODE& node) { withdraw_synchronous(node); }

void change_object(CO_NODE& node, const CO_OBJ& obj) {
  for (CO_TPDO& pdo : node.TPdo) {
    if (find(node, pdo.Map, obj) != pdo.Map.Num) {
      set(pdo, touched);
      node.Touched = 1;
    }
  }
  settle_touched(node);
}

// What Read functions change meanwhile is sent, too; what is changed by that waits for the next event.
void settle_touched(CO_NODE& node) {
  constexpr unsigned rounds = 2;
  for (unsigned round = 0; round < rounds && node.Touched != 0 && node.OdLocked == 0; ++round) {
    node.Touched = 0;
    for (CO_TPDO& pdo : node.TPdo) {
      send_touched(pdo);
    }
  }
}

CO_ERR request(CO_NODE& node, uint16_t number) {
  CO_TPDO& pdo = node.TPdo[number];
  if (!is_operational(node)) {
    return CO_ERR_NMT_MODE;
  }
  const CO_ERR err = exists(pdo) ? trigger(pdo) : CO_ERR_TPDO_COM_OBJ;
  settle_touched(node);
  return err;
}

bool trigger_object(CO_NODE& node, const CO_OBJ& obj) {
  bool is_mapped = false;
  for (uint16_t number = 0; number < CO_TPDO_N; ++number) {
    CO_TPDO& pdo = node.TPdo[number];
    if (find(node, pdo.Map, obj) != pdo.Map.Num) {
      is_mapped = true;
      const CO_ERR err = request(node, number);
      node.Error = err == CO_ERR_NONE ? node.Error : err;
    }
  }
  return is_mapped;
}

bool was_sent(CO_NODE& node, uint16_t number) {
  CO_TPDO& pdo = node.TPdo[number];
  const bool was = has(pdo, sent);
  clear(pdo, sent);
  return was;
}

bool was_sent(CO_NODE& node, const CO_OBJ& obj) {
  bool was = false;
  for (CO_TPDO& pdo : node.TPdo) {
    const uint8_t place = find(node, pdo.Map, obj);
    was |= place != pdo.Map.Num && has_passed(pdo.Map, place);
  }
  return was;
}

void remap_tpdos(CO_NODE& node) {
  for (uint16_t number = 0; number < CO_TPDO_N; ++number) {
    CO_PDO_MAP& map = node.TPdo[number].Map;
    if (map.Num != 0 &&
        resolve(node, Direction::transmit, static_cast<uint16_t>(first_tpdo + number), map) != CO_ERR_NONE) {
      configure_tpdo(node, number);
    }
  }
}

}  // namespace co::pdo

#endif
