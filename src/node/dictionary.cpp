// SPDX-License-Identifier: Apache-2.0
// Replaces the dictionary of a running node. Only programs that call CODictInit() link it.
#include "base/error.hpp"
#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/lock.hpp"
#include "node/parts.hpp"

namespace co::node {
namespace {

// Reads parameters from the dictionary again and finds the mapped objects of PDOs, SRDOs and recorders in it.
// Meanwhile, TPDOs that a type function requests are marked, as their objects may not have been found yet.
void remap(CO_NODE& node) {
  parts::run<&Part::of_halt>(node);
  const dict::Lock lock(node);
  parts::run<&Part::of_remap>(node);
  event::defer(node, event::configure);
}

}  // namespace
}  // namespace co::node

extern "C" int16_t CODictInit(CO_DICT* cod, CO_NODE_T* node, CO_OBJ* root, uint16_t max) {
  if (cod == nullptr || node == nullptr || root == nullptr || max == 0) {
    return -1;
  }
  if (co::event::is_working(*node)) {
    co::error::report(*node, CO_ERR_DICT_BUSY);
    return -1;
  }
  const co::event::Call call(*node);
  const CO_ERR err = co::dict::set_table(*cod, *node, root, max);
  co::parts::run<&co::Part::of_table>(*node);
  co::access::close_moved(*node);  // SDO transfers whose entry is no longer at the same address
  if ((node->State & co::event::running) != 0) {
    co::node::remap(*node);
  }
  if (err != CO_ERR_NONE) {
    return -1;
  }
  return static_cast<int16_t>(cod->Num < INT16_MAX ? cod->Num : INT16_MAX);
}
