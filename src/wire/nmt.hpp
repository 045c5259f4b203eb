// SPDX-License-Identifier: Apache-2.0
// NMT and error control frames. [301:7.2.8]
#pragma once

#include "co_nmt.h"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t no_node_id = 255;  // of an unconfigured node [305]
constexpr bool is_node_id(uint8_t id) { return id >= 1 && id <= 127; }

inline constexpr uint8_t nmt_dlc = 2;

// Command specifiers of "NMT node control". [301:7.2.8.2.1]
enum class NmtCommand : uint8_t {
  start = 1,
  stop = 2,
  enter_pre_operational = 128,
  reset_node = 129,
  reset_communication = 130,
};

constexpr bool addresses(const CO_IF_FRM& nmt, uint8_t node_id) { return nmt.Data[1] == 0 || nmt.Data[1] == node_id; }

// State byte of heartbeats, by CO_MODE. [301:7.2.8.3.2.2]
inline constexpr uint8_t heartbeat_states[CO_MODE_NUM] = {255, 0, 127, 5, 4};
constexpr uint8_t heartbeat_state(CO_MODE mode) {
  return mode < CO_MODE_NUM ? heartbeat_states[mode] : heartbeat_states[CO_INVALID];
}

inline constexpr uint8_t error_control_dlc = 1;

// Toggle bit, bit 7 of a response to node guarding. [301:7.2.8.2.2.1]
inline constexpr uint8_t guarding_toggle = 0x80;

// Returns a heartbeat, or a response to node guarding with its toggle bit. mode: below CO_MODE_NUM
inline CO_IF_FRM error_control(uint8_t node_id, CO_MODE mode, uint8_t toggle_bit = 0) {
  CO_IF_FRM frame = empty_frame(CobId::error_control + node_id, error_control_dlc);
  frame.Data[0] = static_cast<uint8_t>(heartbeat_states[mode] | toggle_bit);
  return frame;
}

// Returns the NMT state in an error control frame, without the toggle bit.
constexpr uint8_t state_of(const CO_IF_FRM& error_control) {
  return static_cast<uint8_t>(error_control.Data[0] & (guarding_toggle - 1U));
}

constexpr CO_IF_FRM nmt_command(uint8_t command, uint8_t node_id) {
  return {static_cast<uint32_t>(CobId::nmt), {command, node_id}, nmt_dlc};
}

// Returns the boot-up message: a heartbeat with the state Initialisation. [301:7.2.8.3.3]
inline CO_IF_FRM boot_up(uint8_t node_id) { return error_control(node_id, CO_INIT); }

static_assert(heartbeat_state(CO_INIT) == 0x00 && heartbeat_state(CO_STOP) == 0x04);
static_assert(heartbeat_state(CO_OPERATIONAL) == 0x05 && heartbeat_state(CO_PREOP) == 0x7F);
static_assert(state_of({0x701, {0xFF}, 1}) == 0x7F && state_of({0x701, {0x04}, 1}) == 0x04);
static_assert(nmt_command(0x82, 0x7F).Identifier == 0x000 && nmt_command(0x82, 0x7F).Data[1] == 0x7F);

}  // namespace co::wire
