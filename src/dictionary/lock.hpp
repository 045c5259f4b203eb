// SPDX-License-Identifier: Apache-2.0
// Lock of mapped objects, which are read or written together.
#pragma once

#include "co_assert.h"
#include "co_core.h"

namespace co::dict {

// Scope in which CO_NODE_EXT.OdLock is held. Scopes may nest.
class Lock {
 public:
  explicit Lock(CO_NODE& node) : node_(node) {
    if (node.OdLocked++ == 0 && node.Ext->OdLock != nullptr) {
      node.Ext->OdLock(node.Ext->User);
    }
  }
  ~Lock() {
    CO_ASSERT(node_.OdLocked != 0);
    if (--node_.OdLocked == 0 && node_.Ext->OdUnlock != nullptr) {
      node_.Ext->OdUnlock(node_.Ext->User);
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  CO_NODE& node_;
};

}  // namespace co::dict
