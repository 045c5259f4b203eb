// SPDX-License-Identifier: Apache-2.0
// Callbacks of the application. Each function calls the one in CO_NODE_EXT.Callbacks or, if the table has none, the C
// function of the same purpose. Either may call any API function: the node may be stopped afterwards.
#pragma once

#include "co_core.h"

namespace co::callback {

// Returns a function of the table; null if there is none.
template <class Function>
[[nodiscard]] inline Function find(const CO_NODE& node, Function CO_CALLBACKS::*entry) {
  if constexpr (USE_CALLBACKS == 0) {
    return nullptr;
  } else {
    const CO_CALLBACKS* const table = node.Ext->Callbacks;
    return table == nullptr ? nullptr : table->*entry;
  }
}

inline void change_mode(CO_NODE& node, CO_MODE mode) {
  const auto function = find(node, &CO_CALLBACKS::ModeChange);
  return function != nullptr ? function(&node, node.Ext->User, mode) : CONmtModeChange(&node.Nmt, mode);
}

inline void request_reset(CO_NODE& node, CO_NMT_RESET reset) {
  const auto function = find(node, &CO_CALLBACKS::ResetRequest);
  return function != nullptr ? function(&node, node.Ext->User, reset) : CONmtResetRequest(&node.Nmt, reset);
}

inline void miss_heartbeat(CO_NODE& node, uint8_t node_id) {
  const auto function = find(node, &CO_CALLBACKS::HbConsEvent);
  return function != nullptr ? function(&node, node.Ext->User, node_id) : CONmtHbConsEvent(&node.Nmt, node_id);
}

inline void change_heartbeat(CO_NODE& node, uint8_t node_id, CO_MODE mode) {
  const auto function = find(node, &CO_CALLBACKS::HbConsChange);
  return function != nullptr ? function(&node, node.Ext->User, node_id, mode)
                             : CONmtHbConsChange(&node.Nmt, node_id, mode);
}

inline void guard_life(CO_NODE& node, bool occurred) {
  const auto function = find(node, &CO_CALLBACKS::LifeGuardEvent);
  return function != nullptr ? function(&node, node.Ext->User, occurred) : CONmtLifeGuardEvent(&node.Nmt, occurred);
}

inline void receive_frame(CO_NODE& node, CO_IF_FRM& frame) {
  const auto function = find(node, &CO_CALLBACKS::CanReceive);
  return function != nullptr ? function(&node, node.Ext->User, &frame) : COIfCanReceive(&frame);
}

inline void change_can(CO_NODE& node, CO_CAN_EVENT event) {
  const auto function = find(node, &CO_CALLBACKS::CanChange);
  return function != nullptr ? function(&node, node.Ext->User, event) : CONodeCanChange(&node, event);
}

inline void transmit_pdo(CO_NODE& node, CO_IF_FRM& frame) {
  const auto function = find(node, &CO_CALLBACKS::PdoTransmit);
  return function != nullptr ? function(&node, node.Ext->User, &frame) : COPdoTransmit(&frame);
}

[[nodiscard]] inline int16_t receive_pdo(CO_NODE& node, CO_IF_FRM& frame) {
  const auto function = find(node, &CO_CALLBACKS::PdoReceive);
  return function != nullptr ? function(&node, node.Ext->User, &frame) : COPdoReceive(&frame);
}

inline void update_pdo_at_sync(CO_NODE& node, CO_RPDO& pdo) {
  const auto function = find(node, &CO_CALLBACKS::PdoSyncUpdate);
  return function != nullptr ? function(&node, node.Ext->User, &pdo) : COPdoSyncUpdate(&pdo);
}

inline void update_pdo(CO_NODE& node, CO_RPDO& pdo) {
  const auto function = find(node, &CO_CALLBACKS::PdoUpdate);
  return function != nullptr ? function(&node, node.Ext->User, &pdo) : COPdoUpdate(&pdo);
}

[[nodiscard]] inline int16_t set_para_defaults(CO_NODE& node, CO_PARA& group) {
  const auto function = find(node, &CO_CALLBACKS::ParaDefault);
  return function != nullptr ? function(&node, node.Ext->User, &group) : COParaDefault(&group);
}

inline void lose_para(CO_NODE& node, const CO_PARA& group) {
  const auto function = find(node, &CO_CALLBACKS::ParaLost);
  return function != nullptr ? function(&node, node.Ext->User, &group) : COParaLost(&node, &group);
}

[[nodiscard]] inline CO_ERR load_lss(CO_NODE& node, uint32_t& baud, uint8_t& node_id) {
  const auto function = find(node, &CO_CALLBACKS::LssLoad);
  return function != nullptr ? function(&node, node.Ext->User, &baud, &node_id) : COLssLoad(&baud, &node_id);
}

[[nodiscard]] inline CO_ERR store_lss(CO_NODE& node, uint32_t baud, uint8_t node_id) {
  const auto function = find(node, &CO_CALLBACKS::LssStore);
  return function != nullptr ? function(&node, node.Ext->User, baud, node_id) : COLssStore(baud, node_id);
}

inline void update_time(CO_NODE& node, const CO_TIME_OF_DAY& time) {
  const auto function = find(node, &CO_CALLBACKS::TimeUpdate);
  return function != nullptr ? function(&node, node.Ext->User, &time) : COTimeUpdate(&node, &time);
}

inline void receive_gfc(CO_NODE& node) {
  const auto function = find(node, &CO_CALLBACKS::GfcReceived);
  return function != nullptr ? function(&node, node.Ext->User) : COGfcReceived(&node);
}

inline void change_srdo(CO_NODE& node, uint8_t number, CO_SRDO_STATE state) {
  const auto function = find(node, &CO_CALLBACKS::SrdoChange);
  return function != nullptr ? function(&node, node.Ext->User, number, state) : COSrdoChange(&node, number, state);
}

inline void change_leds(CO_NODE& node, uint8_t leds) {
  const auto function = find(node, &CO_CALLBACKS::LedChange);
  return function != nullptr ? function(&node, node.Ext->User, leds) : COLedChange(&node, leds);
}

inline void receive_emcy(CO_NODE& node, uint8_t node_id, uint16_t code, uint8_t reg, const uint8_t* msef) {
  const auto function = find(node, &CO_CALLBACKS::EmcyReceived);
  return function != nullptr ? function(&node, node.Ext->User, node_id, code, reg, msef)
                             : COEmcyReceived(&node, node_id, code, reg, msef);
}

inline void recover_para(CO_NODE& node, const CO_PARA& group) {
  const auto function = find(node, &CO_CALLBACKS::ParaRecovered);
  if (function != nullptr) {
    function(&node, node.Ext->User, &group);
  }
}

}  // namespace co::callback
