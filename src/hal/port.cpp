// SPDX-License-Identifier: Apache-2.0
#include "hal/port.hpp"

namespace co::port {
namespace {

// Clears the frames that are queued for CONodeProcess(): they are part of the driver's receive queue.
void clear_mainline_ring([[maybe_unused]] const CO_NODE& node) {
#if USE_REAL_TIME
  CORingClear(node.Ext->Mainline);
#endif
}

}  // namespace

void init(CO_NODE& node) {
  const CO_IF& cif = node.If;
  if (cif.Nvm != nullptr) {
    cif.Nvm->Init(cif.NvmCtx);
  }
  cif.Timer->Init(cif.TimerCtx, node.Tmr.Freq);
  can_init(node);
}

void can_init(const CO_NODE& node) {
  node.If.Can->Init(node.If.CanCtx);
  clear_mainline_ring(node);
}

void can_reset(const CO_NODE& node) {
  node.If.Can->Reset(node.If.CanCtx);
  clear_mainline_ring(node);
}

void can_close(const CO_NODE& node) {
  node.If.Can->Close(node.If.CanCtx);
  clear_mainline_ring(node);
}

void can_enable(const CO_NODE& node, uint32_t baud) { node.If.Can->Enable(node.If.CanCtx, baud); }

bool can_has_filter(const CO_NODE& node) { return node.If.Can->Filter != nullptr; }

void can_filter(const CO_NODE& node, const uint32_t* ids, uint16_t num) {
  node.If.Can->Filter(node.If.CanCtx, ids, num);
}

bool nvm_erase(const CO_NODE& node, uint32_t start, uint32_t size) {
  const CO_IF_NVM_DRV_EX& driver = *node.If.Nvm;
  return driver.Erase != nullptr && driver.Erase(node.If.NvmCtx, start, size);
}

uint32_t nvm_read(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size) {
  return nvm_exists(node) ? node.If.Nvm->Read(node.If.NvmCtx, start, buffer, size) : 0;
}

uint32_t nvm_write(const CO_NODE& node, uint32_t start, uint8_t* buffer, uint32_t size) {
  return nvm_exists(node) ? node.If.Nvm->Write(node.If.NvmCtx, start, buffer, size) : 0;
}

}  // namespace co::port
