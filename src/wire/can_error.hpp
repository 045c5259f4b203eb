// SPDX-License-Identifier: Apache-2.0
// Error frames, coded as SocketCAN does: the class in the identifier, details in the data.
#pragma once

#include "co_core.h"

namespace co::wire {

// The event that an error frame reports; CO_CAN_EVENT_NUM: none that matters to a node.
constexpr CO_CAN_EVENT can_event(const CO_IF_FRM& frame) {
  constexpr uint32_t controller = 0x004;
  constexpr uint32_t bus_off = 0x040;
  constexpr uint32_t restarted = 0x100;
  constexpr uint8_t receive_overflow = 0x01;
  constexpr uint8_t passive = 0x10 | 0x20;  // receiver, transmitter
  constexpr uint8_t active = 0x40;
  if ((frame.Identifier & bus_off) != 0) {
    return CO_CAN_BUS_OFF;
  }
  if ((frame.Identifier & restarted) != 0) {
    return CO_CAN_RECOVERED;
  }
  const uint8_t status = (frame.Identifier & controller) != 0 ? frame.Data[1] : static_cast<uint8_t>(0);
  if ((status & receive_overflow) != 0) {
    return CO_CAN_OVERRUN;
  }
  if ((status & passive) != 0) {
    return CO_CAN_PASSIVE;
  }
  return (status & active) != 0 ? CO_CAN_RECOVERED : CO_CAN_EVENT_NUM;
}

}  // namespace co::wire
