// SPDX-License-Identifier: Apache-2.0
// Storage of node-ID and bit rate in the node's non-volatile memory.
#include "base/events.hpp"
#include "hal/port.hpp"
#include "storage/store.hpp"

#if USE_LSS && USE_PARA

namespace co::lss {
namespace {

struct Stored {
  uint32_t baud;
  uint32_t node_id;
};

store::Record record_at(uint32_t offset) {
  constexpr uint32_t version = 0x4C535331;  // "LSS1": distinguishes the record from parameter groups
  return {offset, sizeof(Stored), version, 0};
}

}  // namespace
}  // namespace co::lss

extern "C" {

CO_ERR COLssNvmLoad(CO_NODE* node, uint32_t offset, uint32_t* baud, uint8_t* nodeId) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(baud, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(nodeId, CO_ERR_BAD_ARG);
  co::lss::Stored stored = {};
  // Resets that other threads have requested during the memory access are deferred: event::run_deferred() runs them.
  co::store::Target target = {reinterpret_cast<uint8_t*>(&stored), sizeof stored, false};
  const co::store::Found found = co::store::of(*node).load(*node, co::lss::record_at(offset), target);
  co::event::run_deferred(*node);
  if (found == co::store::Found::data) {
    *baud = stored.baud;
    *nodeId = static_cast<uint8_t>(stored.node_id);
  }
  if (found == co::store::Found::no_room) {
    return CO_ERR_PARA_STORE;
  }
  return found == co::store::Found::lost ? CO_ERR_IF_NVM_READ : CO_ERR_NONE;
}

CO_ERR COLssNvmStore(CO_NODE* node, uint32_t offset, uint32_t baud, uint8_t nodeId) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  if (!co::port::nvm_exists(*node)) {
    return CO_ERR_LSS_NO_STORE;
  }
  const co::lss::Stored stored = {baud, nodeId};
  const CO_ERR err = co::store::of(*node).save(*node, co::lss::record_at(offset),
                                               reinterpret_cast<const uint8_t*>(&stored), co::store::Cause::command);
  co::event::run_deferred(*node);
  return err;
}

}  // extern "C"

#endif
