// SPDX-License-Identifier: Apache-2.0
// RPDOs. [301:7.2.2.5.1]
#include <stddef.h>

#include "base/bits.hpp"
#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/mapping.hpp"
#include "service/pdo/multiplex.hpp"
#include "service/pdo/pdo.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if CO_RPDO_N > 0

namespace co::pdo {
namespace {

using event::Fault;

constexpr unsigned reported = too_short | too_long | late;

static_assert(offsetof(CO_RPDO, Own.Data) % sizeof(Word) == 0);

// Returns whether an RPDO is synchronous. Types 252 and 253 (remote requests) are not possible.
bool applies_at_sync(const CO_RPDO& pdo) { return USE_SYNC != 0 && pdo.Type <= last_synchronous_type; }

// Faults of the bits from too_short to late.
constexpr Fault fault_of_bit[] = {Fault::pdo_short, Fault::pdo_long, Fault::pdo_timeout};

void on_deadline(void* pdo_pointer) { report(*static_cast<CO_RPDO*>(pdo_pointer), late, late); }

// Returns false if the frame is too short. A longer frame is processed. [301:7.2.7.1 table 26]
bool check_length(CO_RPDO& pdo, unsigned length) {
  const unsigned mapped = length_of(pdo.Map);
  if (length == mapped && (pdo.Faults & (too_short | too_long)) == 0) {
    return true;
  }
  if (length < mapped) {
    report(pdo, too_short, too_short);
    return false;
  }
  report(pdo, too_short | too_long, length > mapped ? unsigned{too_long} : 0U);
  return true;
}

// Stores the data until the SYNC; the last frame before the SYNC is used.
void store_until_sync(CO_RPDO& pdo, const CO_IF_FRM& frame) {
  copy_data(pdo.Own.Data, frame.Data);
  bits::add(pdo.Node->PdoSets.Fresh, pdo.Number);
  pdo.Node->HasFresh = 1;
}

void write_and_mark(CO_NODE& node, CO_PDO_MAP& map, CO_IF_FRM& frame) {
  if (copy_objects(node, map, frame, Direction::receive) == CO_ERR_NONE) {
    mark_transferred(map);
  }
}

// Writes the stored data of an RPDO at the SYNC.
void write_stored(CO_NODE& node, CO_RPDO& pdo) {
  CO_IF_FRM frame = wire::empty_frame(0, sizeof pdo.Own.Data);
  copy_data(frame.Data, pdo.Own.Data);
  write_and_mark(node, pdo.Map, frame);
}

void forget_stored(CO_NODE& node) {
  __builtin_memset(node.PdoSets.Fresh, 0, sizeof node.PdoSets.Fresh);
  node.HasFresh = 0;
}

// Processes a frame. Returns false if it is too short.
[[gnu::noinline]] bool process_frame(CO_NODE& node, CO_RPDO& pdo, const CO_IF_FRM& frame) {
  if (is_switching(node) || (applies_at_sync(pdo) && node.WindowOver != 0)) {
    return true;
  }
  if (!check_length(pdo, frame.DLC)) {
    return false;
  }
  if (pdo.Deadline != 0) {
    restart_deadline(pdo);
  }
  CO_IF_FRM copy = frame;
  if (callback::receive_pdo(node, copy) != 0) {
    return true;
  }
  if (applies_at_sync(pdo)) {
    store_until_sync(pdo, copy);
    return true;
  }
  write_and_mark(node, pdo.Map, copy);
  callback::update_pdo(node, pdo);
  return true;
}

}  // namespace

uint8_t detail_of(const CO_RPDO& pdo) {
  const unsigned number = pdo.Number + 1U;
  return static_cast<uint8_t>(CO_RPDO_N < UINT8_MAX || number < UINT8_MAX ? number : UINT8_MAX);
}

void report(CO_RPDO& pdo, unsigned faults, unsigned is) {
  unsigned bit = too_short;
  for (const Fault fault : fault_of_bit) {
    if (((pdo.Faults ^ is) & faults & bit) != 0) {
      const uint8_t detail = detail_of(pdo);
      pdo.Faults = static_cast<uint8_t>(pdo.Faults ^ bit);
      event::change_fault(*pdo.Node, fault, (is & bit) != 0 ? event::Change::occurred : event::Change::ended, detail);
    }
    bit <<= 1U;
  }
}

void restart_deadline(CO_RPDO& pdo) {
  if (pdo.Deadline != 0) {
    tmr::start(*pdo.Node, pdo.Tmr, pdo.Deadline, 0, on_deadline, &pdo);
  }
  report(pdo, late, 0);
}

// Stops the deadline and resolves all faults.
void end_rpdo(CO_NODE& node, CO_PDO& pdo) {
  tmr::stop(node, pdo.Tmr);
  report(pdo, reported, 0);
  mpdo::end_rpdo(pdo);
}

// The deadline starts with the first frame.
void begin_rpdo(CO_PDO& pdo, uint32_t identifier, uint32_t event) {
  pdo.Deadline = event;
  pdo.Map.Flags &= changed;
  if (USE_SYNC != 0) {
    bits::remove(pdo.Node->PdoSets.Fresh, pdo.Number);
  }
  routes::change(*pdo.Node, identifier, routes::owner<PartId::rpdo>(pdo.Number));
}

void change_deadline(CO_NODE& node, unsigned number, uint32_t ticks) {
  CO_ASSERT(number < CO_RPDO_N);
  CO_RPDO& pdo = node.RPdo[number];
  const bool is_expected = tmr::is_running(pdo.Tmr);
  pdo.Deadline = ticks;
  if (ticks == 0) {
    tmr::stop(node, pdo.Tmr);
  }
  if (ticks == 0 || is_expected) {
    restart_deadline(pdo);
  }
}

void on_mode_rpdos(CO_NODE& node) {
  if (event::is_allowed(node, CO_PDO_ALLOWED)) {
    return;
  }
  if (USE_SYNC != 0) {
    forget_stored(node);
  }
  for (CO_RPDO& pdo : node.RPdo) {
    end_rpdo(node, pdo);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  CO_ASSERT(number < CO_RPDO_N && (exists(node.RPdo[number].Map) || mpdo::is_mpdo(node.RPdo[number].Map)));
  CO_RPDO& pdo = node.RPdo[number];
  return mpdo::is_mpdo(pdo.Map) ? mpdo::receive(pdo, frame) : process_frame(node, pdo, frame);
}

// Writes all synchronous RPDOs of one SYNC with OdLock held, then calls their callbacks.
void apply(CO_NODE& node, uint8_t) {
  if (node.HasFresh == 0) {
    return;
  }
  node.HasFresh = 0;
  if (is_switching(node)) {
    forget_stored(node);
    return;
  }
  {
    const Lock lock(node);
    bits::for_each(node.PdoSets.Fresh, [&](unsigned n) { write_stored(node, node.RPdo[n]); });
  }
  bits::take_each(node.PdoSets.Fresh, [&](unsigned n) {
    callback::update_pdo_at_sync(node, node.RPdo[n]);
    callback::update_pdo(node, node.RPdo[n]);
  });
}

bool was_received(CO_NODE& node, uint16_t number) {
  CO_ASSERT(number < CO_RPDO_N);
  return take_transferred(node.RPdo[number].Map);
}

bool was_received(CO_NODE& node, const CO_OBJ& obj) {
  const uint16_t entry = number_of(node, obj);
  bool was = false;
  for (CO_RPDO& pdo : node.RPdo) {
    was |= take_transferred(pdo.Map, entry);
  }
  return was;
}

}  // namespace co::pdo

#else  // functions for configurations without them

namespace co::pdo {

void end_rpdo(CO_NODE&, CO_PDO&) {}
void begin_rpdo(CO_PDO&, uint32_t, uint32_t) {}
void change_deadline(CO_NODE&, unsigned, uint32_t) {}
bool was_received(CO_NODE&, uint16_t) { return false; }
bool was_received(CO_NODE&, const CO_OBJ&) { return false; }

}  // namespace co::pdo

#endif
