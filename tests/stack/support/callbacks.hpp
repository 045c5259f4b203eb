// SPDX-License-Identifier: Apache-2.0
/// \file callbacks.hpp
/// Functions that a test sets for the callbacks of the stack, which have fixed names. The destructor of a Fixture
/// clears them all.
#pragma once

#include <cstdint>
#include <functional>

#include "co_core.h"

namespace test {

struct Callbacks {
  std::function<void(CO_NMT*, CO_MODE)> mode_change;
  std::function<void(CO_NMT*, CO_NMT_RESET)> reset_request;
  std::function<void(CO_NMT*, std::uint8_t)> heartbeat_event;
  std::function<void(CO_NMT*, std::uint8_t, CO_MODE)> heartbeat_change;
  std::function<void(CO_NMT*, bool)> life_guard;
  std::function<void(CO_IF_FRM*)> can_receive;
  std::function<void(CO_NODE*, CO_CAN_EVENT)> can_change;
  std::function<void(CO_IF_FRM*)> pdo_transmit;
  std::function<std::int16_t(CO_IF_FRM*)> pdo_receive;
  std::function<void(CO_RPDO*)> pdo_sync_update;
  std::function<void(CO_RPDO*)> pdo_update;
  std::function<void(CO_NODE*, const CO_TIME_OF_DAY*)> time_update;
  std::function<void(CO_NODE*)> gfc_received;
  std::function<void(CO_NODE*, std::uint8_t, CO_SRDO_STATE)> srdo_change;
  std::function<void(CO_NODE*, std::uint8_t)> led_change;
  std::function<void(CO_NODE*, std::uint8_t, std::uint16_t, std::uint8_t, const std::uint8_t*)> emcy_received;
  std::function<CO_ERR(std::uint32_t*, std::uint8_t*)> lss_load;
  std::function<CO_ERR(std::uint32_t, std::uint8_t)> lss_store;
  std::function<std::int16_t(CO_PARA*)> para_default;
  std::function<void(CO_NODE*, const CO_PARA*)> para_lost;
  std::function<void()> lock;
  std::function<void()> unlock;
  std::function<void()> od_lock;    ///< CO_NODE_EXT.OdLock
  std::function<void()> od_unlock;  ///< CO_NODE_EXT.OdUnlock
  std::function<void()> enter;      ///< CO_NODE_EXT.Enter
  std::function<void()> leave;      ///< CO_NODE_EXT.Leave
  unsigned fatal_errors = 0;        ///< calls of CONodeFatalError(), which returns to its caller in tests
};

Callbacks& callbacks();

}  // namespace test
