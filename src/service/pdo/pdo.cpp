// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/pdo.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/mpdo.hpp"

// Functions for configurations without RPDOs or without TPDOs.

namespace co::pdo {

#if CO_RPDO_N == 0
void end_rpdo(CO_NODE&, CO_PDO&) {}
void begin_rpdo(CO_PDO&, unsigned, uint32_t, uint32_t) {}
void apply(CO_NODE&) {}
bool was_received(CO_NODE&, uint16_t) { return false; }
bool was_received(CO_NODE&, const CO_OBJ&) { return false; }
#endif

#if CO_TPDO_N == 0
void end_tpdo(CO_NODE&, CO_PDO&) {}
void begin_tpdo(CO_PDO&, unsigned, uint32_t, bool) {}
void sample(CO_NODE& node, uint8_t) { node.WindowOver = 0; }
void end_window(CO_NODE& node) { node.WindowOver = 1; }
void flush(CO_NODE&) {}
CO_ERR change_object(CO_NODE&, const CO_OBJ&) { return CO_ERR_TPDO_OBJ_TRIGGER; }
CO_ERR send_marked(CO_NODE&) { return CO_ERR_NONE; }
CO_ERR request(CO_NODE&, uint16_t) { return CO_ERR_TPDO_NUM_TRIGGER; }
CO_ERR request_object(CO_NODE&, const CO_OBJ&) { return CO_ERR_TPDO_OBJ_TRIGGER; }
#if USE_MPDO
CO_ERR send_to(CO_NODE&, uint16_t, uint8_t, uint32_t, uint32_t) { return CO_ERR_TPDO_NUM_TRIGGER; }
#endif
bool was_sent(CO_NODE&, uint16_t) { return false; }
bool was_sent(CO_NODE&, const CO_OBJ&) { return false; }
#endif

}  // namespace co::pdo

using namespace co;

namespace {

// Returns whether a PDO has this number. A function, because a comparison with a count of 0 PDOs causes a compiler
// warning.
constexpr bool is_pdo(uint16_t number, unsigned count) { return number < count; }

// Returns whether an entry belongs to the table of the node: the index of an entry of another table would select an
// unrelated entry.
bool is_entry(const CO_NODE& node, const CO_OBJ* obj) {
  const auto root = reinterpret_cast<uintptr_t>(node.Dict.Root);
  return reinterpret_cast<uintptr_t>(obj) - root < node.Dict.Num * sizeof *obj;
}

}  // namespace

extern "C" {

void COTPdoTrigPdo(CO_TPDO* tpdo, uint16_t num) {
  ASSERT_PTR_FATAL(tpdo);
  ASSERT_PTR_FATAL(tpdo->Node);
  error::report(*tpdo->Node, COTPdoRequest(tpdo->Node, num), pdo::key_of_tpdo(num));
}

void COTPdoTrigObj(CO_TPDO* tpdo, CO_OBJ* obj) {
  ASSERT_PTR_FATAL(tpdo);
  ASSERT_PTR_FATAL(tpdo->Node);
  CO_NODE& node = *tpdo->Node;
  const bool is_known = is_entry(node, obj);
  const uint32_t key = is_known ? obj->Key : 0;
  error::report(node, is_known ? pdo::request_object(node, *obj) : CO_ERR_TPDO_OBJ_TRIGGER, key);
  event::run_deferred(node);
}

CO_ERR COTPdoRequest(CO_NODE* node, uint16_t num) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
#if USE_MPDO && CO_TPDO_N > 0
  if (is_pdo(num, CO_TPDO_N)) {
    mpdo::mark_all(node->TPdo[num]);
  }
#endif
  const CO_ERR err = is_pdo(num, CO_TPDO_N) ? pdo::request(*node, num) : CO_ERR_TPDO_NUM_TRIGGER;
  event::run_deferred(*node);
  return err;
}

#if USE_MPDO
CO_ERR COTPdoSendTo(CO_NODE* node, uint16_t num, uint8_t node_id, uint32_t key, uint32_t value) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  constexpr uint8_t last_node_id = 127;
  if (node_id > last_node_id) {
    return CO_ERR_BAD_ARG;
  }
  const CO_ERR err = is_pdo(num, CO_TPDO_N) ? pdo::send_to(*node, num, node_id, key, value) : CO_ERR_TPDO_NUM_TRIGGER;
  event::run_deferred(*node);
  return err;
}
#endif

bool CORPdoWasReceived(CO_NODE* node, uint16_t num) {
  return node != nullptr && is_pdo(num, CO_RPDO_N) && pdo::was_received(*node, num);
}

bool COTPdoWasSent(CO_NODE* node, uint16_t num) {
  return node != nullptr && is_pdo(num, CO_TPDO_N) && pdo::was_sent(*node, num);
}

bool CORPdoObjWasReceived(CO_NODE* node, const CO_OBJ* obj) {
  return node != nullptr && is_entry(*node, obj) && pdo::was_received(*node, *obj);
}

bool COTPdoObjWasSent(CO_NODE* node, const CO_OBJ* obj) {
  return node != nullptr && is_entry(*node, obj) && pdo::was_sent(*node, *obj);
}

}  // extern "C"
