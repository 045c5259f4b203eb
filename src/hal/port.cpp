// SPDX-License-Identifier: Apache-2.0
#include "hal/port.hpp"

namespace co::port {
namespace {

// Functions of drivers that do nothing (no_drivers).
void nothing(void*) {}
void no_rate(void*, uint32_t) {}
int16_t no_frame(void*, CO_IF_FRM*) { return 0; }
int16_t not_sent(void*, const CO_IF_FRM*) { return 0; }
uint32_t no_time(void*) { return 0; }

constexpr CO_IF_CAN_DRV_EX no_can = {nothing, no_rate, no_frame, not_sent, nothing, nothing, nullptr, nullptr};
constexpr CO_IF_TIMER_DRV_EX no_timer = {no_rate, no_time, nullptr};

constexpr CO_NODE_EXT with_drivers(const CO_IF_CAN_DRV_EX* can, const CO_IF_TIMER_DRV_EX* timer) {
  CO_NODE_EXT ext = {};
  ext.Size = sizeof ext;
  ext.Can = can;
  ext.Timer = timer;
  return ext;
}

// Calls a function of the CAN driver, in the form that the node has.
void call(const CO_NODE& node, void (*CO_IF_CAN_DRV_EX::*with_context)(void*), void (*CO_IF_CAN_DRV::*plain)()) {
  const CO_NODE_EXT& ext = *node.Ext;
  ext.Can != nullptr ? (ext.Can->*with_context)(ext.CanCtx) : (node.If.Drv->Can->*plain)();
}

// Clears the frames that are queued for CONodeProcess(): they are part of the driver's receive queue.
void forget_received([[maybe_unused]] const CO_NODE& node) {
#if USE_REAL_TIME
  CORingClear(node.Ext->Mainline);
#endif
}

}  // namespace

const CO_IF_DRV no_plain_drivers = {nullptr, nullptr, nullptr};
const CO_NODE_EXT no_extension = with_drivers(nullptr, nullptr);
const CO_NODE_EXT no_drivers = with_drivers(&no_can, &no_timer);

void init(CO_NODE& node) {
  const CO_NODE_EXT& ext = *node.Ext;
  if (ext.Nvm != nullptr) {
    ext.Nvm->Init(ext.NvmCtx);
  } else if (node.If.Drv->Nvm != nullptr) {
    node.If.Drv->Nvm->Init();
  }
  if (ext.Timer != nullptr) {
    ext.Timer->Init(ext.TimerCtx, node.Tmr.Freq);
  } else {
    node.If.Drv->Timer->Init(node.Tmr.Freq);
  }
  can_init(node);
}

void can_init(const CO_NODE& node) {
  call(node, &CO_IF_CAN_DRV_EX::Init, &CO_IF_CAN_DRV::Init);
  forget_received(node);
}

void can_reset(const CO_NODE& node) {
  call(node, &CO_IF_CAN_DRV_EX::Reset, &CO_IF_CAN_DRV::Reset);
  forget_received(node);
}

void can_close(const CO_NODE& node) {
  call(node, &CO_IF_CAN_DRV_EX::Close, &CO_IF_CAN_DRV::Close);
  forget_received(node);
}

void can_enable(const CO_NODE& node, uint32_t baud) {
  node.Ext->Can != nullptr ? node.Ext->Can->Enable(node.Ext->CanCtx, baud) : node.If.Drv->Can->Enable(baud);
}

bool can_wants_filter(const CO_NODE& node) { return node.Ext->Can != nullptr && node.Ext->Can->Filter != nullptr; }

void can_filter(const CO_NODE& node, const uint32_t* ids, uint16_t num) {
  node.Ext->Can->Filter(node.Ext->CanCtx, ids, num);
}

int16_t can_send(const CO_NODE& node, const CO_IF_FRM& frame) {
  if (node.Ext->Can != nullptr) {
    return node.Ext->Can->Send(node.Ext->CanCtx, &frame);
  }
  CO_IF_FRM copy = frame;  // classic drivers may change the frame
  return node.If.Drv->Can->Send(&copy);
}

bool nvm_exists(const CO_NODE& node) { return node.Ext->Nvm != nullptr || node.If.Drv->Nvm != nullptr; }

bool nvm_erase(const CO_NODE& node, uint32_t start, uint32_t size) {
  const CO_IF_NVM_DRV_EX& driver = *node.Ext->Nvm;
  return driver.Erase != nullptr && driver.Erase(node.Ext->NvmCtx, start, size);
}

uint32_t nvm_read(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size) {
  if (node.Ext->Nvm != nullptr) {
    return node.Ext->Nvm->Read(node.Ext->NvmCtx, start, buffer, size);
  }
  const CO_IF_NVM_DRV* const driver = node.If.Drv->Nvm;
  return driver == nullptr ? 0 : driver->Read(start, buffer, size);
}

uint32_t nvm_write(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size) {
  if (node.Ext->Nvm != nullptr) {
    return node.Ext->Nvm->Write(node.Ext->NvmCtx, start, buffer, size);
  }
  const CO_IF_NVM_DRV* const driver = node.If.Drv->Nvm;
  return driver == nullptr ? 0 : driver->Write(start, buffer, size);
}

}  // namespace co::port
