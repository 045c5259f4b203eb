// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/pdo.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "hal/port.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/multiplex.hpp"

namespace co::pdo {
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
}  // namespace co::pdo

extern "C" {

void COTPdoTrigPdo(CO_TPDO* tpdo, uint16_t num) {
  ASSERT_PTR_FATAL(tpdo);
  ASSERT_PTR_FATAL(tpdo->Node);
  co::error::report(*tpdo->Node, COTPdoRequest(tpdo->Node, num), co::pdo::key_of_tpdo(num));
}

void COTPdoTrigObj(CO_TPDO* tpdo, CO_OBJ* obj) {
  ASSERT_PTR_FATAL(tpdo);
  ASSERT_PTR_FATAL(tpdo->Node);
  CO_NODE& node = *tpdo->Node;
  const co::event::Call call(node);
  const bool is_known = co::pdo::is_entry(node, obj);
  const uint32_t key = is_known ? obj->Key : 0;
  co::error::report(node, is_known ? co::pdo::request_object(node, *obj) : CO_ERR_TPDO_OBJ_TRIGGER, key);
}

CO_ERR COTPdoRequest(CO_NODE* node, uint16_t num) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  if (!co::pdo::is_pdo(num, CO_TPDO_N) || !co::port::is_initialised(*node)) {
    return CO_ERR_TPDO_NUM_TRIGGER;
  }
  const co::event::Call call(*node);
  co::mpdo::mark_all(co::pdo::tpdos(*node).first[num]);
  return co::pdo::request(*node, num);
}

bool CORPdoWasReceived(CO_NODE* node, uint16_t num) {
  return node != nullptr && co::pdo::is_pdo(num, CO_RPDO_N) && co::pdo::was_received(*node, num);
}

bool COTPdoWasSent(CO_NODE* node, uint16_t num) {
  return node != nullptr && co::pdo::is_pdo(num, CO_TPDO_N) && co::pdo::was_sent(*node, num);
}

bool CORPdoObjWasReceived(CO_NODE* node, const CO_OBJ* obj) {
  return node != nullptr && co::pdo::is_entry(*node, obj) && co::pdo::was_received(*node, *obj);
}

bool COTPdoObjWasSent(CO_NODE* node, const CO_OBJ* obj) {
  return node != nullptr && co::pdo::is_entry(*node, obj) && co::pdo::was_sent(*node, *obj);
}

}  // extern "C"
