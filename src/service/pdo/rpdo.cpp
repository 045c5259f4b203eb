// SPDX-License-Identifier: Apache-2.0
// RPDOs. [301:7.2.2.5.1]
#include "core/dict.hpp"
#include "core/events.hpp"
#include "core/routes.hpp"
#include "core/timer.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/pdo.hpp"
#include "wire/cob_id.hpp"

#if CO_RPDO_N > 0

namespace co::pdo {
namespace {

using event::Fault;

enum Flag : uint8_t {
  synchronous = 0x01,
  queued = 0x02,     // it is in the list of those that wait for the SYNC
  fresh = 0x04,      // Data has not been written yet
  received = 0x08,   // since the application has asked
  too_short = 0x10,  // reported
  too_long = 0x20,   // reported
  late = 0x40,       // reported
};

// Links of the list are numbers from 1.
constexpr uint16_t none = 0;
CO_RPDO& at(CO_NODE& node, uint16_t link) { return node.RPdo[link - 1]; }

bool has(const CO_RPDO& pdo, Flag flag) { return (pdo.Map.Flags & flag) != 0; }
void set(CO_RPDO& pdo, Flag flag) { pdo.Map.Flags = static_cast<uint8_t>(pdo.Map.Flags | flag); }
void clear(CO_RPDO& pdo, Flag flag) { pdo.Map.Flags = static_cast<uint8_t>(pdo.Map.Flags & ~flag); }

uint16_t number_of(const CO_RPDO& pdo) { return static_cast<uint16_t>(&pdo - pdo.Node->RPdo); }
// The number of the PDO, from 1; 255 for all above.
uint8_t detail(const CO_RPDO& pdo) {
  const unsigned number = number_of(pdo) + 1U;
  return static_cast<uint8_t>(number < UINT8_MAX ? number : UINT8_MAX);
}

// Each fault is reported once, until it is gone.
void report(CO_RPDO& pdo, Flag flag, Fault fault) {
  if (!has(pdo, flag)) {
    set(pdo, flag);
    event::raise(*pdo.Node, fault, detail(pdo));
  }
}

void resolve(CO_RPDO& pdo, Flag flag, Fault fault) {
  if (has(pdo, flag)) {
    clear(pdo, flag);
    event::resolve(*pdo.Node, fault, detail(pdo));
  }
}

void resolve_all(CO_RPDO& pdo) {
  resolve(pdo, too_short, Fault::pdo_short);
  resolve(pdo, too_long, Fault::pdo_long);
  resolve(pdo, late, Fault::pdo_timeout);
}

void on_deadline(void* pdo_pointer) { report(*static_cast<CO_RPDO*>(pdo_pointer), late, Fault::pdo_timeout); }

void watch(CO_RPDO& pdo) {
  resolve(pdo, late, Fault::pdo_timeout);
  if (pdo.Event != 0) {
    tmr::start(pdo.Node->Tmr, pdo.Tmr, pdo.Event, 0, on_deadline, &pdo);
  }
}

// A frame longer than the mapping is taken. [301:7.2.7.1 table 26]
bool check_length(CO_RPDO& pdo, uint8_t length) {
  if (length < pdo.Map.Length) {
    report(pdo, too_short, Fault::pdo_short);
    return false;
  }
  resolve(pdo, too_short, Fault::pdo_short);
  if (length > pdo.Map.Length) {
    report(pdo, too_long, Fault::pdo_long);
  } else {
    resolve(pdo, too_long, Fault::pdo_long);
  }
  return true;
}

void write(CO_RPDO& pdo, const CO_IF_FRM& frame) {
  const Lock lock(*pdo.Node);
  pdo::write(*pdo.Node, pdo.Map, frame);
  set(pdo, received);
}

// Keeps the data; the last that comes before the SYNC counts.
void keep(CO_RPDO& pdo, const CO_IF_FRM& frame) {
  CO_NODE& node = *pdo.Node;
  __builtin_memcpy(pdo.Data, frame.Data, sizeof pdo.Data);
  set(pdo, fresh);
  if (has(pdo, queued)) {
    return;
  }
  set(pdo, queued);
  const auto link = static_cast<uint16_t>(number_of(pdo) + 1);
  pdo.Next = none;
  (node.RPdoFirst == none ? node.RPdoFirst : at(node, node.RPdoLast).Next) = link;
  node.RPdoLast = link;
}

void write_kept(CO_NODE& node, CO_RPDO& pdo) {
  if (!has(pdo, fresh)) {
    return;
  }
  CO_IF_FRM frame = {0, {}, sizeof pdo.Data};
  __builtin_memcpy(frame.Data, pdo.Data, sizeof pdo.Data);
  pdo::write(node, pdo.Map, frame);
  set(pdo, received);
}

void forget_kept(CO_NODE& node) {
  for (uint16_t link = node.RPdoFirst; link != none; link = at(node, link).Next) {
    clear(at(node, link), queued);
    clear(at(node, link), fresh);
  }
  node.RPdoFirst = none;
}

// Both are called while nothing else of the list can change: frames and resets wait.
void tell(CO_NODE& node, uint16_t first) {
  for (uint16_t link = first; link != none; link = at(node, link).Next) {
    CO_RPDO& pdo = at(node, link);
    clear(pdo, queued);
    if (has(pdo, fresh)) {
      clear(pdo, fresh);
      COPdoSyncUpdate(&pdo);
      COPdoUpdate(&pdo);
    }
  }
}

bool is_kept_from(const CO_NODE& node, const CO_RPDO& pdo) { return has(pdo, synchronous) && node.WindowOver != 0; }

}  // namespace

void configure_rpdo(CO_NODE& node, uint16_t number) {
  CO_RPDO& pdo = node.RPdo[number];
  const auto kept = static_cast<uint8_t>(pdo.Map.Flags & queued);
  Parameters parameters = {};
  resolve_all(pdo);
  tmr::stop(node.Tmr, pdo.Tmr);
  configure(node, Direction::receive, static_cast<uint16_t>(first_rpdo + number), parameters, pdo.Map);
  pdo.Event = parameters.event;
  pdo.Map.Flags = static_cast<uint8_t>(kept | (is_synchronous(parameters.type) ? synchronous : 0));
  const bool exists = pdo.Map.Num != 0;
  routes::change(node, exists ? wire::frame_id(parameters.cob_id) : wire::no_frame, routes::Service::rpdo, number);
}

void change_deadline(CO_NODE& node, uint16_t number, uint32_t ticks) {
  CO_RPDO& pdo = node.RPdo[number];
  pdo.Event = ticks;
  if (ticks == 0) {
    tmr::stop(node.Tmr, pdo.Tmr);
    resolve(pdo, late, Fault::pdo_timeout);
  } else if (tmr::is_running(pdo.Tmr)) {
    watch(pdo);
  }
}

void init_rpdos(CO_NODE& node) {
  node.RPdoFirst = none;
  for (uint16_t number = 0; number < CO_RPDO_N; ++number) {
    node.RPdo[number].Node = &node;
    node.RPdo[number].Map.Flags = 0;
    configure_rpdo(node, number);
  }
}

// What was reported is over when process data are no longer exchanged.
void on_mode_rpdos(CO_NODE& node) {
  if (event::is_allowed(node, CO_PDO_ALLOWED)) {
    return;
  }
  forget_kept(node);
  for (CO_RPDO& pdo : node.RPdo) {
    tmr::stop(node.Tmr, pdo.Tmr);
    resolve_all(pdo);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  CO_RPDO& pdo = node.RPdo[number];
  if (is_kept_from(node, pdo)) {
    return true;
  }
  if (!check_length(pdo, frame.DLC)) {
    return false;
  }
  watch(pdo);
  CO_IF_FRM copy = frame;
  if (COPdoReceive(&copy) != 0 || pdo.Map.Num == 0 || !event::is_allowed(node, CO_PDO_ALLOWED)) {
    return true;
  }
  if (has(pdo, synchronous)) {
    keep(pdo, copy);
  } else {
    write(pdo, copy);
    settle_touched(node);
    COPdoUpdate(&pdo);
  }
  return true;
}

// All of one SYNC together.
void apply(CO_NODE& node) {
  const uint16_t first = node.RPdoFirst;
  if (first == none) {
    return;
  }
  node.RPdoFirst = none;
  {
    const Lock lock(node);
    for (uint16_t link = first; link != none; link = at(node, link).Next) {
      write_kept(node, at(node, link));
    }
  }
  settle_touched(node);
  tell(node, first);
}

bool was_received(CO_NODE& node, uint16_t number) {
  CO_RPDO& pdo = node.RPdo[number];
  const bool was = has(pdo, received);
  clear(pdo, received);
  return was;
}

bool was_received(CO_NODE& node, const CO_OBJ& obj) {
  bool was = false;
  for (CO_RPDO& pdo : node.RPdo) {
    const uint8_t place = find(node, pdo.Map, obj);
    was |= place != pdo.Map.Num && has_passed(pdo.Map, place);
  }
  return was;
}

void remap_rpdos(CO_NODE& node) {
  for (uint16_t number = 0; number < CO_RPDO_N; ++number) {
    CO_PDO_MAP& map = node.RPdo[number].Map;
    if (map.Num != 0 &&
        resolve(node, Direction::receive, static_cast<uint16_t>(first_rpdo + number), map) != CO_ERR_NONE) {
      configure_rpdo(node, number);
    }
  }
}

}  // namespace co::pdo

#endif
