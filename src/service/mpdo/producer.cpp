// SPDX-License-Identifier: Apache-2.0
// Producer of multiplex PDOs. [301:7.2.3]
#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "service/mpdo/mpdo.hpp"
#include "service/pdo/mapping.hpp"
#include "service/pdo/multiplex.hpp"
#include "wire/mpdo.hpp"

#if CO_MPDO_N > 0 && CO_TPDO_N > 0

namespace co::mpdo {
namespace {

CO_TPDO* producer(CO_NODE& node) {
  CO_ASSERT(node.Mpdo.Producer <= CO_TPDO_N);
  return node.Mpdo.Producer == no_producer ? nullptr : &node.TPdo[node.Mpdo.Producer - 1];
}

// Calls the callback of the application, queues the frame and marks the PDO as sent. A queued frame is not replaced,
// because it may contain another object.
CO_ERR send(CO_TPDO& pdo, CO_IF_FRM& frame) {
  callback::transmit_pdo(*pdo.Node, frame);
  if (!transmit::send_for_application(*pdo.Node, frame)) {
    return CO_ERR_IF_CAN_SEND;
  }
  pdo::mark_transferred(pdo.Map);
  return CO_ERR_NONE;
}

// Reads an object of the scanner list into a frame. Errors of the object are reported.
CO_ERR read(CO_TPDO& pdo, uint16_t entry, CO_IF_FRM& frame) {
  CO_NODE& node = *pdo.Node;
  CO_OBJ* const obj = object_at(node, entry);
  const CO_ERR err = obj != nullptr ? map_object(node, pdo.Map, *obj) : CO_ERR_OBJ_NOT_FOUND;
  if (err != CO_ERR_NONE) {
    error::report(node, err, obj != nullptr ? obj->Key : 0);
    return err;
  }
  frame = wire::mpdo(pdo.Identifier, node.NodeId, CO_GET_DEV(obj->Key), 0);
  return pdo::copy_objects(node, pdo.Map, frame, Direction::transmit);
}

// Sends an object of the scanner list. It stays pending if the transmit queue is full.
CO_ERR send_object(CO_TPDO& pdo, uint16_t position) {
  CO_NODE& node = *pdo.Node;
  CO_ASSERT(position < node.Mpdo.ScanNum);
  const uint16_t entry = node.Mpdo.Scan[position];
  CO_IF_FRM frame;
  CO_ERR err = read(pdo, entry, frame);
  if (err == CO_ERR_NONE) {
    err = send(pdo, frame);
  }
  if (err != CO_ERR_IF_CAN_SEND) {
    finish_object(node, position, entry, err == CO_ERR_NONE);
  }
  return err;
}

}  // namespace

void begin_tpdo(CO_PDO& pdo, unsigned number) {
  uint16_t& producer = pdo.Node->Mpdo.Producer;
  const auto own = static_cast<uint16_t>(number + 1);
  if (is_sam(pdo.Map)) {
    producer = own;
  } else if (producer == own) {
    producer = no_producer;
  }
  if (is_dam(pdo.Map)) {
    pdo.Own.Time.Event = 0;
  }
}

CO_ERR send_pending(CO_PDO& pdo) {
  CO_NODE& node = *pdo.Node;
  const bool all = pdo.Own.Time.Inhibit == 0;
  CO_ERR result = node.Mpdo.ScanNum != 0 ? CO_ERR_NONE : CO_ERR_TPDO_OBJ_TRIGGER;
  uint16_t position = 0;
  bool goes_on = true;
  CO_ASSERT(is_sam(pdo.Map) && producer(node) == &pdo);
  for (uint16_t left = node.Mpdo.ScanNum; left != 0 && goes_on && next(node, position); --left) {
    transmit::flush(node);
    if (transmit::is_waiting(node)) {
      break;
    }
    const CO_ERR err = send_object(pdo, position);
    result = err != CO_ERR_NONE ? err : result;
    goes_on = all || err != CO_ERR_NONE;
  }
  if (all && is_waiting(node)) {
    node.Transmit.Paused = 1;
  }
  return result;
}

bool is_pending(const CO_PDO& pdo) { return is_sam(pdo.Map) && is_waiting(*pdo.Node); }

void clear_marks(CO_PDO& pdo) {
  if (is_sam(pdo.Map)) {
    clear_marks(*pdo.Node);
  }
}

CO_ERR send_to(CO_NODE& node, uint16_t number, uint8_t node_id, uint32_t key, uint32_t value) {
  if (number >= CO_TPDO_N) {
    return CO_ERR_TPDO_NUM_TRIGGER;
  }
  CO_TPDO& pdo = node.TPdo[number];
  if (!pdo::is_operational(node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!is_dam(pdo.Map)) {
    return pdo::exists(pdo.Map) ? CO_ERR_TPDO_MAP_OBJ : CO_ERR_TPDO_COM_OBJ;
  }
  if (pdo::has(pdo.Map, pdo::inhibited)) {
    return CO_ERR_TPDO_INHIBIT;
  }
  CO_IF_FRM frame = wire::mpdo(pdo.Identifier, static_cast<uint8_t>(wire::mpdo_to_consumer | node_id), key, value);
  pdo::set(pdo.Map, pdo::inhibited);
  const CO_ERR err = send(pdo, frame);
  pdo::clear(pdo.Map, pdo::inhibited);
  pdo::restart(pdo);
  return err;
}

bool on_free(CO_NODE& node, uint16_t) {
  CO_TPDO* const pdo = producer(node);
  if (pdo != nullptr && pdo::is_operational(node) && !pdo::has(pdo->Map, pdo::inhibited) && is_waiting(node)) {
    (void)pdo::send_event(*pdo, pdo::Cause::event);
  }
  return false;
}

}  // namespace co::mpdo

#endif

// Marks of the objects in the object scanner list: pending, sent.

#if CO_MPDO_N > 0

namespace co::mpdo {
namespace {

bool has_bit(const uint8_t* bits, uint16_t position) { return (bits[position / 8U] & (1U << (position % 8U))) != 0; }
void set_bit(uint8_t* bits, uint16_t position) {
  bits[position / 8U] = static_cast<uint8_t>(bits[position / 8U] | 1U << (position % 8U));
}
void clear_bit(uint8_t* bits, uint16_t position) {
  bits[position / 8U] = static_cast<uint8_t>(bits[position / 8U] & ~(1U << (position % 8U)));
}

}  // namespace

bool mark(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  bool found = false;
  for (uint16_t position = 0; position < mpdo.ScanNum; ++position) {
    if (mpdo.Scan[position] == entry) {
      set_bit(mpdo.Waiting, position);
      found = true;
    }
  }
  return found;
}

void mark_all(CO_PDO& pdo) {
  CO_MPDO& mpdo = pdo.Node->Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  for (uint16_t position = 0; is_sam(pdo.Map) && position < mpdo.ScanNum; ++position) {
    set_bit(mpdo.Waiting, position);
  }
}

void clear_marks(CO_NODE& node) { __builtin_memset(node.Mpdo.Waiting, 0, sizeof node.Mpdo.Waiting); }

bool is_waiting(const CO_NODE& node) {
  uint8_t any = 0;
  for (const uint8_t bits : node.Mpdo.Waiting) {
    any |= bits;
  }
  return any != 0;
}

bool next(CO_NODE& node, uint16_t& position) {
  const CO_MPDO& mpdo = node.Mpdo;
  position = mpdo.NextObject;
  for (uint16_t n = 0; n < mpdo.ScanNum; ++n, ++position) {
    position = position < mpdo.ScanNum ? position : 0;
    if (has_bit(mpdo.Waiting, position)) {
      return true;
    }
  }
  return false;
}

// Checks the list again, because a callback may have changed it.
void finish_object(CO_NODE& node, uint16_t position, uint16_t entry, bool sent) {
  CO_MPDO& mpdo = node.Mpdo;
  if (position >= mpdo.ScanNum || mpdo.Scan[position] != entry) {
    return;
  }
  clear_bit(mpdo.Waiting, position);
  mpdo.NextObject = static_cast<uint16_t>(position + 1);
  if (sent) {
    set_bit(mpdo.Transferred, position);
  }
}

bool was_sent(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  bool was = false;
  for (uint16_t position = 0; position < mpdo.ScanNum; ++position) {
    if (mpdo.Scan[position] == entry) {
      was |= has_bit(mpdo.Transferred, position);
      clear_bit(mpdo.Transferred, position);
    }
  }
  return was;
}

Transferred transferred(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  unsigned position = 0;
  while (position < mpdo.ScanNum && mpdo.Scan[position] != entry) {
    ++position;
  }
  return {mpdo.Transferred, position, mpdo.ScanNum};
}

}  // namespace co::mpdo

#endif
