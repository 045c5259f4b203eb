// SPDX-License-Identifier: Apache-2.0
#include "storage/store.hpp"

#include "hal/port.hpp"
#include "storage/slots.hpp"

#if USE_PARA

namespace co::store {
namespace {

// Returns the functions for the node's memory; null if it has none that can store groups.
const CO_STORE_T* store_of(const CO_NODE& node) { return port::nvm_has_shape(node) ? &slots::store : node.If.Raw; }

}  // namespace

bool is_atomic(const CO_NODE& node) { return port::nvm_has_shape(node); }

uint32_t space(const CO_NODE& node, uint32_t size) {
  const CO_STORE_T* const store = store_of(node);
  return store == nullptr ? 0 : store->space(node, size);
}

Found find(const CO_NODE& node, const Record& record) {
  const CO_STORE_T* const store = store_of(node);
  return store == nullptr ? Found::blank : store->find(node, record);
}

Loaded load(CO_NODE& node, const Record& record, uint8_t* to, uint32_t size) {
  const CO_STORE_T* const store = store_of(node);
  return store == nullptr ? Loaded{Found::blank, false} : store->load(node, record, to, size);
}

CO_ERR save(CO_NODE& node, const Record& record, const uint8_t* data) {
  const CO_STORE_T* const store = store_of(node);
  return store == nullptr ? CO_ERR_IF_NVM_WRITE : store->save(node, record, data);
}

CO_ERR save_defaults(CO_NODE& node, const Record& record) { return save(node, record, nullptr); }

}  // namespace co::store

#endif
