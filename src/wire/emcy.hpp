// SPDX-License-Identifier: Apache-2.0
// EMCY frames. [301:7.2.7.3.1]
#pragma once

#include "co_emcy.h"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t emcy_dlc = 8;

// Returns a message. low: error code, in bits 16…23 the error register, then the first byte of the
// manufacturer-specific error field; high: its other bytes. The first byte is the lowest.
inline CO_IF_FRM emcy(uint32_t identifier, uint32_t low, uint32_t high) {
  CO_IF_FRM frame;
  frame.Identifier = identifier;
  put_low(frame, low);
  put_high(frame, high);
  frame.DLC = emcy_dlc;
  return frame;
}

// Return the members of a received frame. emcy_bytes(): the five bytes of the manufacturer-specific error field.
inline uint16_t emcy_code(const CO_IF_FRM& frame) { return get_u16(frame.Data); }
inline uint8_t emcy_register(const CO_IF_FRM& frame) { return frame.Data[2]; }
inline const uint8_t* emcy_bytes(const CO_IF_FRM& frame) { return frame.Data + 3; }

}  // namespace co::wire
