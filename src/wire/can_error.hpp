// SPDX-License-Identifier: Apache-2.0
// Error frames in the format of SocketCAN: the error class in the identifier, details in the data.
#pragma once

#include "co_core.h"

namespace co::wire {

inline constexpr uint32_t error_controller = 0x004;
inline constexpr uint32_t error_bus_off = 0x040;
inline constexpr uint32_t error_restarted = 0x100;

// Bits of Data[1] in an error frame of the class error_controller.
inline constexpr uint8_t controller_overflow = 0x01;        // a received frame was lost
inline constexpr uint8_t controller_passive = 0x10 | 0x20;  // receiving, transmitting
inline constexpr uint8_t controller_active = 0x40;

// Bits that report an event: an error class, or a status of the controller.
struct ErrorBits {
  uint16_t error_class;
  uint8_t status;
};
inline constexpr ErrorBits error_bits[CO_CAN_EVENT_NUM] = {
    {0, controller_overflow}, {0, controller_passive}, {error_bus_off, 0}, {error_restarted, controller_active}};

// Returns whether an error frame reports this event; it may report several.
constexpr bool reports(const CO_IF_FRM& frame, CO_CAN_EVENT event) {
  const ErrorBits& bits = error_bits[event];
  const unsigned status = (frame.Identifier & error_controller) != 0 ? frame.Data[1] : 0U;
  return (frame.Identifier & bits.error_class) != 0 || (status & bits.status) != 0;
}

static_assert(reports({0x20000040, {}, 8}, CO_CAN_BUS_OFF) && !reports({0x20000040, {}, 8}, CO_CAN_RECOVERED));
static_assert(reports({0x20000004, {0, 0x11}, 8}, CO_CAN_OVERRUN) &&
              reports({0x20000004, {0, 0x11}, 8}, CO_CAN_PASSIVE));

}  // namespace co::wire
