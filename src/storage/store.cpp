// SPDX-License-Identifier: Apache-2.0
#include "storage/store.hpp"

#include "hal/port.hpp"

#if USE_PARA

namespace co::store {
namespace {

Found load_nothing(CO_NODE&, const Record&, Target&) { return Found::blank; }

CO_ERR refuse(CO_NODE&, const Record&, const uint8_t*, Cause) { return CO_ERR_IF_NVM_WRITE; }

constexpr CO_STORE_T none = {load_nothing, refuse};  // the node has no memory that can store groups

}  // namespace

const CO_STORE_T& of(const CO_NODE& node) {
  if (port::nvm_has_shape(node)) {
    return slots::store;
  }
  return node.If.Raw != nullptr ? *node.If.Raw : none;
}

uint32_t space(CO_NODE& node, const Record& record) {
  if (port::nvm_has_shape(node)) {
    return slots::space(node, record);
  }
  return node.If.Raw != nullptr && port::nvm_exists(node) ? record.size : 0;
}

}  // namespace co::store

#endif
