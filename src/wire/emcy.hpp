// SPDX-License-Identifier: Apache-2.0
// EMCY frames. [301:7.2.7.3.1]
#pragma once

#include "co_emcy.h"
#include "wire/frame.hpp"

namespace co::wire {

inline constexpr uint8_t emcy_dlc = 8;

// Returns a message with an error code and the five bytes of the manufacturer-specific error field.
constexpr CO_EMCY_MSG emcy_message(uint16_t code, const uint8_t* msef) {
  return {code | (uint32_t{msef[0]} << 24), get_u32(msef + 1)};
}

// Returns the message of a fault of the stack: an error code, and detail (24 bits, see base/events.hpp) as third to
// fifth byte of the manufacturer-specific error field. The first two, which are also in 1003h, are 0. [301:7.5.2.4]
constexpr CO_EMCY_MSG emcy_message(uint16_t code, uint32_t detail) { return {code, detail << 8}; }

// Returns the message with the error register, byte 2 of the frame, behind the error code.
constexpr CO_EMCY_MSG with_register(const CO_EMCY_MSG& msg, uint8_t reg) {
  return {msg.Low | (uint32_t{reg} << 16), msg.High};
}

// Returns the frame of a message that contains the error register.
inline CO_IF_FRM emcy(uint32_t identifier, const CO_EMCY_MSG& msg) {
  CO_IF_FRM frame = empty_frame(identifier, emcy_dlc);
  put_low(frame, msg.Low);
  put_high(frame, msg.High);
  return frame;
}

// Return the members of a received frame. emcy_bytes(): the five bytes of the manufacturer-specific error field.
inline uint16_t emcy_code(const CO_IF_FRM& frame) { return get_u16(frame.Data); }
inline uint8_t emcy_register(const CO_IF_FRM& frame) { return frame.Data[2]; }
inline const uint8_t* emcy_bytes(const CO_IF_FRM& frame) { return frame.Data + 3; }

inline constexpr uint8_t emcy_example[] = {0xAB, 1, 2, 3, 4};
static_assert(with_register(emcy_message(0x8210, emcy_example), 0x11).Low == 0xAB118210);
static_assert(with_register(emcy_message(0x8210, emcy_example), 0x11).High == 0x04030201);
static_assert(with_register(emcy_message(0x8130, uint32_t{5}), 0x11).Low == 0x00118130);
static_assert(with_register(emcy_message(0x8130, uint32_t{5}), 0x11).High == 0x00000500);
static_assert(emcy_message(0x8200, uint32_t{0x071301}).High == 0x07130100);

}  // namespace co::wire
