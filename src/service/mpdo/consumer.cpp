// SPDX-License-Identifier: Apache-2.0
// Consumer of multiplex PDOs. [301:7.2.3]
#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "service/mpdo/mpdo.hpp"
#include "service/pdo/mapping.hpp"
#include "service/pdo/multiplex.hpp"
#include "wire/cob_id.hpp"
#include "wire/mpdo.hpp"

#if CO_MPDO_N > 0 && CO_RPDO_N > 0

namespace co::mpdo {
namespace {

using event::Fault;

// Returns whether the frame has the addressing mode of the PDO.
bool is_kind(const CO_PDO_MAP& map, uint32_t low) {
  const uint8_t address = wire::mpdo_address(low);
  const bool to_consumer = (address & wire::mpdo_to_consumer) != 0;
  return is_dam(map) ? to_consumer : !to_consumer && address != 0;
}

// Returns whether the frame addresses this node.
bool is_addressed(const CO_NODE& node, const CO_PDO_MAP& map, uint32_t low) {
  const uint8_t node_id = wire::mpdo_address(low) & wire::mpdo_node_id;
  return !is_dam(map) || node_id == 0 || node_id == node.NodeId;
}

// Returns the object that the dispatching list assigns to an object of the producer; null: none.
CO_OBJ* dispatch(CO_NODE& node, uint32_t producer) {
  CO_ASSERT(node.Mpdo.BlockNum <= CO_MPDO_N);
  for (uint16_t n = 0; n < node.Mpdo.BlockNum; ++n) {
    const CO_MPDO_BLOCK& block = node.Mpdo.Block[n];
    const uint32_t distance = producer - block.Producer;
    const uint32_t position = distance / wire::mpdo_next_sub;
    if (distance % wire::mpdo_next_sub == 0 && position < block.Num) {
      return object_at(node, static_cast<uint16_t>(block.Entry + position));
    }
  }
  return nullptr;
}

// Returns the object to which the frame is written; null: none.
CO_OBJ* find(CO_NODE& node, const CO_PDO_MAP& map, uint32_t low) {
  const uint32_t key = wire::mpdo_key(low);
  if (is_sam(map)) {
    return dispatch(node, key | wire::mpdo_address(low));
  }
  CO_OBJ* const obj = dict::find(node, key);
  return check_object(node, Direction::receive, obj, key) == CO_ERR_NONE ? obj : nullptr;
}

// Writes the data of the frame to an object, and marks the object and the PDO as received.
void write(CO_NODE& node, CO_PDO_MAP& map, CO_OBJ& obj, CO_IF_FRM& frame) {
  if (map_object(node, map, obj) == CO_ERR_NONE &&
      pdo::copy_objects(node, map, frame, Direction::receive) == CO_ERR_NONE) {
    pdo::mark_transferred(map);
  }
}

// Raises or resolves the fault that a frame names no object.
void report_unknown(CO_RPDO& pdo, bool is_unknown) {
  if (((pdo.Faults & pdo::unknown) != 0) == is_unknown) {
    return;
  }
  pdo.Faults ^= pdo::unknown;
  event::change_fault(*pdo.Node, Fault::pdo_unknown, is_unknown ? event::Change::occurred : event::Change::ended,
                      pdo::detail_of(pdo));
}

// Writes the object that the frame names. Returns false if there is none.
bool find_and_write(CO_NODE& node, CO_RPDO& pdo, CO_IF_FRM& frame) {
  CO_OBJ* const obj = find(node, pdo.Map, wire::get_low(frame));
  if (obj != nullptr || is_dam(pdo.Map)) {
    report_unknown(pdo, obj == nullptr);
  }
  if (obj == nullptr) {
    return false;
  }
  write(node, pdo.Map, *obj, frame);
  return true;
}

// Processes a frame. Returns false if it is too short or of the wrong kind.
bool process_frame(CO_NODE& node, CO_RPDO& pdo, const CO_IF_FRM& frame) {
  CO_IF_FRM copy = frame;
  const uint32_t low = wire::get_low(frame);
  const bool is_short = frame.DLC < wire::mpdo_dlc;
  pdo::report(pdo, pdo::too_short, is_short ? unsigned{pdo::too_short} : 0U);
  if (is_short || !is_kind(pdo.Map, low)) {
    return false;
  }
  if (!is_addressed(node, pdo.Map, low)) {
    return true;
  }
  if (pdo.Deadline != 0) {
    pdo::restart_deadline(pdo);
  }
  if (callback::receive_pdo(node, copy) == 0 && find_and_write(node, pdo, copy)) {
    callback::update_pdo(node, pdo);
  }
  return true;
}

}  // namespace

bool receive(CO_PDO& pdo, const CO_IF_FRM& frame) {
  CO_NODE& node = *pdo.Node;
  return pdo::is_switching(node) || process_frame(node, pdo, frame);
}

void end_rpdo(CO_PDO& pdo) { report_unknown(pdo, false); }

}  // namespace co::mpdo

#endif
