// SPDX-License-Identifier: Apache-2.0
/// \file nodes.hpp
/// The two nodes: a device at the first controller, and a master at the second one, which a test may use instead.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace zynqmp {

constexpr std::uint8_t device_id = 5;
constexpr std::uint8_t master_id = 1;

extern CO_NODE device;
extern CO_NODE master;

/// Variables of the device's object dictionary, and their defaults.
struct DeviceObjects {
  std::uint8_t error_register = 0;
  std::uint8_t history_number = 0;
  std::uint32_t history[4] = {};
  std::uint32_t sync_id = 0x80;
  std::uint32_t sync_cycle = 0;  // µs
  std::uint16_t heartbeat_time = 0;
  std::uint32_t rpdo_id[2] = {0x200 + device_id, 0x300 + device_id};
  std::uint32_t tpdo_id[2] = {0x180 + device_id, 0x280 + device_id};
  std::uint8_t rpdo_type[2] = {255, 1};
  std::uint8_t tpdo_type[2] = {255, 1};
  std::uint16_t tpdo_inhibit = 0;  // x 100 µs
  std::uint16_t tpdo_event = 0;    // ms
  std::uint8_t byte = 0;
  std::uint16_t word = 0;
  std::uint32_t number = 0;
  std::uint32_t received[2] = {};  // RPDO 1, RPDO 2
  std::uint32_t sent[2] = {};      // TPDO 1, TPDO 2
  std::uint8_t memory[3000] = {};
};
extern DeviceObjects objects;
CO_OBJ* device_object(std::uint16_t index, std::uint8_t sub);

struct MasterObjects {
  std::uint8_t error_register = 0;
  std::uint32_t sync_cycle = 0;  // µs
  std::uint32_t sync_id = 0x40000080;
  std::uint32_t sent = 0;
  std::uint32_t received = 0;
};
extern MasterObjects master_objects;

/// Number of callbacks of a node, and their last arguments, since its initialisation.
struct CallbackRecord {
  unsigned can_events[CO_CAN_EVENT_NUM];
  unsigned heartbeat_events;
  CO_MODE last_mode;  ///< last NMT state of a monitored node
  unsigned resets[CO_RESET_NUM];
  unsigned pdos;
  unsigned emergencies;
  std::uint16_t last_emergency;  ///< error code of the last EMCY
};
CallbackRecord& record_of(const CO_NODE& node);

/// Initialise a node at its controller: its variables have their defaults, its CallbackRecord is empty. The node stays
/// in CO_INIT.
void init_device();
void init_master();

}  // namespace zynqmp
