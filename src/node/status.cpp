// SPDX-License-Identifier: Apache-2.0
// 1002h, manufacturer status register. [301:7.5.2.3]
#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"

namespace co::node {
namespace {

constexpr uint32_t key_status = CO_DEV(0x1002, 0);

// Writes the status and triggers its TPDOs. An object with flag A is triggered by its type.
CO_ERR replace_status(CO_NODE& node, const CO_OBJ& obj, uint32_t status) {
  const CO_ERR err = dict::write_u32(node, key_status, status);
  if (err == CO_ERR_NONE && CO_IS_ASYNC(obj.Key) == 0) {
    event::change_object(node, obj);
  }
  return err;
}

}  // namespace
}  // namespace co::node

extern "C" {

CO_ERR CONodeSetStatus(CO_NODE* node, uint32_t status) {
  if (node == nullptr || node->Dict.Node == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const CO_OBJ* const obj = co::dict::find(*node, co::node::key_status);
  if (obj == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  if (CO_IS_DIRECT(obj->Key) != 0) {
    return CO_ERR_OBJ_ACC;
  }
  uint32_t before = 0;
  CO_ERR err = co::dict::read_u32(*node, co::node::key_status, before);
  if (err == CO_ERR_NONE && before != status) {
    err = co::node::replace_status(*node, *obj, status);
    co::event::run_deferred(*node);
  }
  return err;
}

uint32_t CONodeGetStatus(CO_NODE* node) {
  uint32_t status = 0;
  const bool is_known = node != nullptr && node->Dict.Node != nullptr &&
                        co::dict::read_u32(*node, co::node::key_status, status) == CO_ERR_NONE;
  return is_known ? status : 0;
}

}  // extern "C"
