// SPDX-License-Identifier: Apache-2.0
// Error frames, coded as SocketCAN does: the class in the identifier, details in the data.
#pragma once

#include "co_core.h"

namespace co::wire {

inline constexpr uint32_t error_controller = 0x004;
inline constexpr uint32_t error_bus_off = 0x040;
inline constexpr uint32_t error_restarted = 0x100;

// Data[1] of an error of the class controller.
inline constexpr uint8_t controller_overflow = 0x01;        // of received frames
inline constexpr uint8_t controller_passive = 0x10 | 0x20;  // receiving, transmitting
inline constexpr uint8_t controller_active = 0x40;

// Does an error frame report this event? It may report several.
constexpr bool reports(const CO_IF_FRM& frame, CO_CAN_EVENT event) {
  const uint8_t status = (frame.Identifier & error_controller) != 0 ? frame.Data[1] : static_cast<uint8_t>(0);
  switch (event) {
    case CO_CAN_OVERRUN: return (status & controller_overflow) != 0;
    case CO_CAN_PASSIVE: return (status & controller_passive) != 0;
    case CO_CAN_BUS_OFF: return (frame.Identifier & error_bus_off) != 0;
    case CO_CAN_RECOVERED: return (frame.Identifier & error_restarted) != 0 || (status & controller_active) != 0;
    default: return false;
  }
}

static_assert(reports({0x20000040, {}, 8}, CO_CAN_BUS_OFF) && !reports({0x20000040, {}, 8}, CO_CAN_RECOVERED));
static_assert(reports({0x20000004, {0, 0x11}, 8}, CO_CAN_OVERRUN) &&
              reports({0x20000004, {0, 0x11}, 8}, CO_CAN_PASSIVE));

}  // namespace co::wire
