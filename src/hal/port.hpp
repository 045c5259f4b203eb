// SPDX-License-Identifier: Apache-2.0
// Calls of drivers and lock hooks: no other module calls them. Each driver is a classic driver (CO_IF_DRV, as in
// CANopen-Stack) or a driver with context argument (CO_NODE_EXT).
#pragma once

#include "co_core.h"

namespace co::port {

// Extension of a node that was initialised without one.
extern const CO_NODE_EXT no_extension;

// Drivers of a node whose CO_NODE_SPEC contains none.
extern const CO_IF_DRV no_plain_drivers;

// Extension of a node that could not be initialised: its drivers do nothing, so that API calls of the application have
// no effect.
extern const CO_NODE_EXT no_drivers;

void init(CO_NODE& node);

inline void lock(CO_NODE& node) { node.Ext->Lock != nullptr ? node.Ext->Lock(node.Ext->User) : COTmrLock(); }
inline void unlock(CO_NODE& node) { node.Ext->Unlock != nullptr ? node.Ext->Unlock(node.Ext->User) : COTmrUnlock(); }

// Returns whether the node has a real-time thread.
[[nodiscard]] inline bool has_mainline([[maybe_unused]] const CO_NODE& node) {
#if USE_REAL_TIME
  return node.Ext != nullptr && node.Ext->Mainline != nullptr;
#else
  return false;
#endif
}

// Node lock (CO_NODE_EXT.Enter and Leave). NodeLock holds it for a scope. Scopes must not nest.
#if USE_REAL_TIME
inline void enter(CO_NODE& node) {
  if (node.Ext != nullptr && node.Ext->Enter != nullptr) {
    node.Ext->Enter(node.Ext->User);
    node.IsNodeLocked = 1;
  }
}
inline void leave(CO_NODE& node, const CO_NODE_EXT* ext) {
  if (ext != nullptr && ext->Leave != nullptr) {
    node.IsNodeLocked = 0;
    ext->Leave(ext->User);
  }
}

class NodeLock {
 public:
  explicit NodeLock(CO_NODE& node) : node_(node), ext_(node.Ext) { enter(node); }
  ~NodeLock() { leave(node_, ext_); }
  NodeLock(const NodeLock&) = delete;
  NodeLock& operator=(const NodeLock&) = delete;

 private:
  CO_NODE& node_;
  const CO_NODE_EXT* ext_;
};
#else
inline void enter(CO_NODE&) {}
inline void leave(CO_NODE&, const CO_NODE_EXT*) {}

class NodeLock {
 public:
  explicit NodeLock(const CO_NODE&) {}
};
#endif

// Returns whether the timer driver has a clock. Drivers with context argument have one; classic drivers count down and
// return the ticks that are left.
[[nodiscard]] inline bool has_clock(const CO_NODE& node) { return node.Ext->Timer != nullptr; }
[[nodiscard]] inline uint32_t now(const CO_NODE& node) { return node.Ext->Timer->Now(node.Ext->TimerCtx); }
[[nodiscard]] inline uint32_t ticks_left(const CO_NODE& node) { return node.If.Drv->Timer->Delay(); }
[[nodiscard]] inline bool has_elapsed(const CO_NODE& node) { return node.If.Drv->Timer->Update() != 0; }
// Requests a call of COTmrService() some ticks after now (0: no call). Without an Alarm function the driver is polled
// by the loop.
inline void set_alarm(const CO_NODE& node, uint32_t ticks) {
  const CO_NODE_EXT& ext = *node.Ext;
  if (ext.Timer->Alarm != nullptr) {
    ext.Timer->Alarm(ext.TimerCtx, ticks);
  }
}

// Like set_alarm(), for a classic driver. stopped: the driver is not counting.
inline void count_down(const CO_NODE& node, uint32_t ticks, bool stopped) {
  const CO_IF_TIMER_DRV& driver = *node.If.Drv->Timer;
  if (ticks == 0) {
    driver.Stop();
    return;
  }
  driver.Reload(ticks);
  if (stopped) {
    driver.Start();
  }
}

void can_init(const CO_NODE& node);
void can_enable(const CO_NODE& node, uint32_t baud);
void can_reset(const CO_NODE& node);
void can_close(const CO_NODE& node);
void can_filter(const CO_NODE& node, const uint32_t* ids, uint16_t num);
[[nodiscard]] bool can_wants_filter(const CO_NODE& node);

// Returns the driver's result: sizeof(CO_IF_FRM), 0 (no frame waits), < 0 (fault).
[[nodiscard]] inline int16_t can_read(const CO_NODE& node, CO_IF_FRM& frame) {
  const CO_NODE_EXT& ext = *node.Ext;
  return ext.Can != nullptr ? ext.Can->Read(ext.CanCtx, &frame) : node.If.Drv->Can->Read(&frame);
}

// Lets the driver report the events of an error frame that it has returned. Returns false if it has no such function.
[[nodiscard]] inline bool can_report(CO_NODE& node, const CO_IF_FRM& frame) {
  const CO_IF_CAN_DRV_EX* const driver = node.Ext->Can;
  if (driver == nullptr || driver->Report == nullptr) {
    return false;
  }
  driver->Report(node.Ext->CanCtx, &node, &frame);
  return true;
}

// Returns the driver's result: sizeof(CO_IF_FRM) (accepted), 0 (not now), < 0 (fault).
[[nodiscard]] int16_t can_send(const CO_NODE& node, const CO_IF_FRM& frame);

[[nodiscard]] bool nvm_exists(const CO_NODE& node);
[[nodiscard]] inline bool nvm_has_shape(const CO_NODE& node) {
  return node.Ext->Nvm != nullptr && node.Ext->Nvm->Shape != nullptr;
}
[[nodiscard]] inline CO_NVM_SHAPE nvm_shape(const CO_NODE& node) { return node.Ext->Nvm->Shape(node.Ext->NvmCtx); }
[[nodiscard]] bool nvm_erase(const CO_NODE& node, uint32_t start, uint32_t size);
[[nodiscard]] uint32_t nvm_read(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size);
[[nodiscard]] uint32_t nvm_write(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size);

// Returns whether a basic type may store a value of size bytes at address (CO_NODE_EXT.Writable).
[[nodiscard]] inline bool is_writable(const CO_NODE& node, const void* address, uint32_t size) {
  return node.Ext->Writable == nullptr || node.Ext->Writable(node.Ext->User, address, size);
}

}  // namespace co::port
