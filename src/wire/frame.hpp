// SPDX-License-Identifier: Apache-2.0
// Frames: access to their data as two aligned words.
#pragma once

#include <stddef.h>

#include "co_if_can.h"
#include "wire/bytes.hpp"

namespace co::wire {

static_assert(offsetof(CO_IF_FRM, Data) % sizeof(uint32_t) == 0);
inline uint32_t get_low(const CO_IF_FRM& frame) { return get_aligned(frame.Data); }
inline uint32_t get_high(const CO_IF_FRM& frame) { return get_aligned(frame.Data + 4); }
inline void put_low(CO_IF_FRM& frame, uint32_t value) { put_aligned(frame.Data, value); }
inline void put_high(CO_IF_FRM& frame, uint32_t value) { put_aligned(frame.Data + 4, value); }

// Returns a frame whose data bytes are 0.
inline CO_IF_FRM empty_frame(uint32_t identifier, uint8_t dlc) {
  CO_IF_FRM frame;
  frame.Identifier = identifier;
  put_low(frame, 0);
  put_high(frame, 0);
  frame.DLC = dlc;
  return frame;
}

// Returns a frame for a driver to fill: all bytes are 0. The padding is cleared with the DLC, because a word takes
// fewer instructions than a byte.
inline CO_IF_FRM empty_frame() {
  CO_IF_FRM frame;
  frame.Identifier = 0;
  put_low(frame, 0);
  put_high(frame, 0);
  __builtin_memset(reinterpret_cast<uint8_t*>(&frame) + offsetof(CO_IF_FRM, DLC), 0,
                   sizeof frame - offsetof(CO_IF_FRM, DLC));
  return frame;
}

// Sets the DLC to the number of data bytes: 9…15 mean 8 bytes [ISO 11898-1]. Returns false for a larger value,
// which is malformed: a driver has passed the length of a CAN FD frame, or garbage.
[[nodiscard]] inline bool normalise_length(CO_IF_FRM& frame) {
  constexpr uint8_t highest_dlc = 15;
  if (frame.DLC > highest_dlc) {
    return false;
  }
  if (frame.DLC > sizeof frame.Data) {
    frame.DLC = sizeof frame.Data;
  }
  return true;
}

}  // namespace co::wire
