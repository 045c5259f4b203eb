// SPDX-License-Identifier: Apache-2.0
// EMCY frames. [301:7.2.7.3.1]
#pragma once

#include "co_emcy.h"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t emcy_dlc = 8;

inline constexpr unsigned emcy_register_byte = 2;

// Returns the message of a fault of the stack, without identifier and error register: an error code, and detail (24
// bits, see base/events.hpp) as third to fifth byte of the manufacturer-specific error field. The first two, which are
// also in 1003h, are 0. [301:7.5.2.4]
inline CO_IF_FRM emcy(uint16_t code, uint32_t detail) {
  CO_IF_FRM frame = empty_frame(0, emcy_dlc);
  put_low(frame, code);
  put_high(frame, detail << 8);
  return frame;
}

// Sets the five bytes of the manufacturer-specific error field.
inline void put_emcy_bytes(CO_IF_FRM& frame, const uint8_t* msef) {
  frame.Data[3] = msef[0];
  put_high(frame, get_u32(msef + 1));
}

// Return the members of a received frame. emcy_bytes(): the five bytes of the manufacturer-specific error field.
inline uint16_t emcy_code(const CO_IF_FRM& frame) { return get_u16(frame.Data); }
inline uint8_t emcy_register(const CO_IF_FRM& frame) { return frame.Data[2]; }
inline const uint8_t* emcy_bytes(const CO_IF_FRM& frame) { return frame.Data + 3; }

}  // namespace co::wire
