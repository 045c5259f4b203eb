// SPDX-License-Identifier: Apache-2.0
// EMCY frames. [301:7.2.7.3.1]
#pragma once

#include "co_emcy.h"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t emcy_dlc = 8;

// Error code, error register, five bytes of the manufacturer.
constexpr uint32_t emcy_low(const CO_EMCY_MSG& msg) {
  return msg.Code | (static_cast<uint32_t>(msg.Reg) << 16) | (static_cast<uint32_t>(msg.Msef[0]) << 24);
}

inline CO_IF_FRM emcy(uint32_t identifier, const CO_EMCY_MSG& msg) {
  CO_IF_FRM frame = empty_frame(identifier, emcy_dlc);
  put_low(frame, emcy_low(msg));
  put_high(frame, get_u32(msg.Msef + 1));
  return frame;
}

inline uint16_t emcy_code(const CO_IF_FRM& frame) { return get_u16(frame.Data); }
inline uint8_t emcy_register(const CO_IF_FRM& frame) { return frame.Data[2]; }
inline const uint8_t* emcy_bytes(const CO_IF_FRM& frame) { return frame.Data + 3; }

static_assert(emcy_low({0x8210, 0x11, {0xAB, 1, 2, 3, 4}}) == 0xAB118210);

}  // namespace co::wire
