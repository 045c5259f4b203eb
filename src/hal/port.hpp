// SPDX-License-Identifier: Apache-2.0
// Calls of drivers, of the timer lock and of the node lock: no other module calls them. All drivers have a context
// argument; hal/classic.cpp has the adapters for classic drivers (CO_IF_DRV, as in CANopen-Stack).
#pragma once

#include "co_core.h"

namespace co::port {

// Returns whether the node has drivers and an extension: otherwise CONodeInit() was not called or has refused the
// drivers, and functions of the API have no effect.
[[nodiscard]] inline bool is_initialised(const CO_NODE& node) { return node.Ext != nullptr; }

#if USE_OD
// Returns the OD_t of the node (co_od.h); null: none.
[[nodiscard]] inline struct OD_T_* od_of(const CO_NODE& node) { return is_initialised(node) ? node.Ext->Od : nullptr; }
#endif

void init(CO_NODE& node);

inline void lock(CO_NODE& node) { node.Ext->Lock != nullptr ? node.Ext->Lock(node.Ext->User) : COTmrLock(); }
inline void unlock(CO_NODE& node) { node.Ext->Unlock != nullptr ? node.Ext->Unlock(node.Ext->User) : COTmrUnlock(); }

// Returns whether the node has a real-time thread.
[[nodiscard]] inline bool has_mainline([[maybe_unused]] const CO_NODE& node) {
#if USE_REAL_TIME
  return is_initialised(node) && node.Ext->Mainline != nullptr;
#else
  return false;
#endif
}

// Node lock (CO_NODE_EXT.Enter and Leave). NodeLock holds it for a scope; scopes must not nest. unlock_node() gets the
// extension that was valid when the lock was taken, because CONodeInit() may replace it meanwhile; null: no effect.
#if USE_REAL_TIME
[[nodiscard]] inline bool has_node_lock(const CO_NODE& node) { return node.Ext->Enter != nullptr; }
inline void lock_node(CO_NODE& node) {
  if (is_initialised(node) && node.Ext->Enter != nullptr) {
    node.Ext->Enter(node.Ext->User);
    node.IsNodeLocked = 1;
  }
}
inline void unlock_node(CO_NODE& node, const CO_NODE_EXT* ext) {
  if (ext != nullptr && ext->Leave != nullptr) {
    node.IsNodeLocked = 0;
    ext->Leave(ext->User);
  }
}

class NodeLock {
 public:
  explicit NodeLock(CO_NODE& node) : node_(node), ext_(node.Ext) { lock_node(node); }
  ~NodeLock() { unlock_node(node_, ext_); }
  NodeLock(const NodeLock&) = delete;
  NodeLock& operator=(const NodeLock&) = delete;

 private:
  CO_NODE& node_;
  const CO_NODE_EXT* ext_;
};
#else
[[nodiscard]] inline bool has_node_lock(const CO_NODE&) { return false; }
inline void lock_node(CO_NODE&) {}
inline void unlock_node(CO_NODE&, const CO_NODE_EXT*) {}

class NodeLock {
 public:
  explicit NodeLock(const CO_NODE&) {}
};
#endif

[[nodiscard]] inline uint32_t now(const CO_NODE& node) { return node.If.Timer->Now(node.If.TimerCtx); }
// Returns whether the timer driver calls COTmrService() at an alarm; otherwise the loop polls it.
[[nodiscard]] inline bool has_alarm(const CO_NODE& node) { return node.If.Timer->Alarm != nullptr; }
// Requests a call of COTmrService() some ticks after now (0: no call), if the driver has alarms.
inline void set_alarm(const CO_NODE& node, uint32_t ticks) {
  if (has_alarm(node)) {
    node.If.Timer->Alarm(node.If.TimerCtx, ticks);
  }
}

// Returns false if a classic timer driver reports that it is still counting.
[[nodiscard]] inline bool has_elapsed(CO_NODE& node) {
  return node.If.HasElapsed == nullptr || node.If.HasElapsed(&node.If);
}

void can_init(const CO_NODE& node);
void can_enable(const CO_NODE& node, uint32_t baud);
void can_reset(const CO_NODE& node);
void can_close(const CO_NODE& node);
void can_filter(const CO_NODE& node, const uint32_t* ids, uint16_t num);
[[nodiscard]] bool can_has_filter(const CO_NODE& node);

// Returns the driver's result: sizeof(CO_IF_FRM), 0 (no frame was received), < 0 (fault).
[[nodiscard]] inline int16_t can_read(const CO_NODE& node, CO_IF_FRM& frame) {
  return node.If.Can->Read(node.If.CanCtx, &frame);
}

// Lets the driver report the events of an error frame that it has returned. Returns false if it has no such function.
[[nodiscard]] inline bool can_report(CO_NODE& node, const CO_IF_FRM& frame) {
  const auto report = node.If.Can->Report;
  if (report == nullptr) {
    return false;
  }
  report(node.If.CanCtx, &node, &frame);
  return true;
}

// Returns the driver's result: sizeof(CO_IF_FRM) (accepted), 0 (not accepted: no free transmit buffer), < 0 (fault).
[[nodiscard]] inline int16_t can_send(const CO_NODE& node, const CO_IF_FRM& frame) {
  return node.If.Can->Send(node.If.CanCtx, &frame);
}

[[nodiscard]] inline bool nvm_exists(const CO_NODE& node) { return node.If.Nvm != nullptr; }
[[nodiscard]] inline bool nvm_has_geometry(const CO_NODE& node) {
  return nvm_exists(node) && node.If.Nvm->Shape != nullptr;
}
[[nodiscard]] inline CO_NVM_SHAPE nvm_geometry(const CO_NODE& node) { return node.If.Nvm->Shape(node.If.NvmCtx); }
[[nodiscard]] bool nvm_erase(const CO_NODE& node, uint32_t start, uint32_t size);
[[nodiscard]] uint32_t nvm_read(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size);
[[nodiscard]] uint32_t nvm_write(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size);

// Returns whether a basic type may store a value of size bytes at address (CO_NODE_EXT.Writable).
[[nodiscard]] inline bool is_writable(const CO_NODE& node, const void* address, uint32_t size) {
  return node.Ext->Writable == nullptr || node.Ext->Writable(node.Ext->User, address, size);
}

}  // namespace co::port

// Adapters for classic drivers (CO_IF_DRV, as in CANopen-Stack). Only programs that call CONodeInit() or CONodeInitEx()
// link them.

namespace co::classic {

// Sets adapters to the classic drivers, except for those kinds of drivers that the node already has.
void add_drivers(CO_IF& cif, CO_IF_DRV& drivers);

}  // namespace co::classic
