// SPDX-License-Identifier: Apache-2.0
// OD_lock() and OD_unlock(): the node lock where several threads use the node, else the lock of mapped objects
// (CO_NODE_EXT.OdLock).
#include "base/events.hpp"
#include "hal/port.hpp"

#if USE_OD

namespace co::od {
namespace {

void lock_objects(CO_NODE& node) {
  if (node.OdLocked++ == 0 && node.Ext->OdLock != nullptr) {
    node.Ext->OdLock(node.Ext->User);
  }
}

void unlock_objects(CO_NODE& node) {
  if (node.OdLocked == 0 || --node.OdLocked != 0) {
    return;
  }
  if (node.Ext->OdUnlock != nullptr) {
    node.Ext->OdUnlock(node.Ext->User);
  }
  event::run_deferred(node);
}

// OD_lock() stores no extension: CONodeInit() must not be called between it and OD_unlock().
void release_node_lock(CO_NODE& node) {
  event::run_deferred(node);
  port::unlock_node(node, node.Ext);
}

}  // namespace
}  // namespace co::od

extern "C" {

void OD_lock(CO_NODE_T* node) {
  ASSERT_PTR_FATAL(node);
  if (!co::port::is_initialised(*node)) {
    return;
  }
  co::port::has_node_lock(*node) ? co::port::lock_node(*node) : co::od::lock_objects(*node);
}

void OD_unlock(CO_NODE_T* node) {
  ASSERT_PTR_FATAL(node);
  if (!co::port::is_initialised(*node)) {
    return;
  }
  co::port::has_node_lock(*node) ? co::od::release_node_lock(*node) : co::od::unlock_objects(*node);
}

}  // extern "C"

#endif
