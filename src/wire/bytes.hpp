// SPDX-License-Identifier: Apache-2.0
// Conversion between bytes of the bus (little-endian [301:7.1.3]) and numbers of the CPU.
#pragma once

#include <stdint.h>

#include "co_cfg.h"

namespace co::wire {

inline constexpr bool host_is_little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

constexpr uint32_t get_u32(const uint8_t* p) {
  return p[0] | (static_cast<uint32_t>(p[1]) << 8) | (static_cast<uint32_t>(p[2]) << 16) |
         (static_cast<uint32_t>(p[3]) << 24);
}

constexpr void put_u32(uint8_t* p, uint32_t value) {
  p[0] = static_cast<uint8_t>(value);
  p[1] = static_cast<uint8_t>(value >> 8);
  p[2] = static_cast<uint8_t>(value >> 16);
  p[3] = static_cast<uint8_t>(value >> 24);
}

// Reads a 32-bit word in the byte order of the bus. p: aligned to 4 bytes
inline uint32_t get_aligned(const uint8_t* p) {
  uint32_t value = 0;
  __builtin_memcpy(&value, __builtin_assume_aligned(p, sizeof value), sizeof value);
  return host_is_little_endian ? value : __builtin_bswap32(value);
}

// Writes a 32-bit word in the byte order of the bus. p: aligned to 4 bytes
inline void put_aligned(uint8_t* p, uint32_t value) {
  value = host_is_little_endian ? value : __builtin_bswap32(value);
  __builtin_memcpy(__builtin_assume_aligned(p, sizeof value), &value, sizeof value);
}

constexpr uint16_t get_u16(const uint8_t* p) { return static_cast<uint16_t>(p[0] | (p[1] << 8)); }

constexpr void put_u16(uint8_t* p, uint16_t value) {
  p[0] = static_cast<uint8_t>(value);
  p[1] = static_cast<uint8_t>(value >> 8);
}

// Data bytes of a segment of an SDO transfer.
inline constexpr uint32_t segment_bytes = 7;
// Copies the data of a segment, at any alignment; source and destination must not overlap.
inline void copy_segment(uint8_t* __restrict to, const uint8_t* __restrict from) {
  to[0] = from[0];
  to[1] = from[1];
  to[2] = from[2];
  to[3] = from[3];
  to[4] = from[4];
  to[5] = from[5];
  to[6] = from[6];
}

// Copies any number of bytes, usually those of a segment: cheaper than a call of memcpy for few bytes, and for many
// that are not aligned.
[[gnu::noinline]] inline void copy(uint8_t* to, const uint8_t* from, uint32_t n) {
  for (; USE_FAST_PATHS != 0 && n >= segment_bytes; n -= segment_bytes) {
    copy_segment(to, from);
    to += segment_bytes;
    from += segment_bytes;
  }
  for (; n != 0; --n) {
    *to++ = *from++;
  }
}

// Converts a number of n bytes from the byte order of the bus to that of the CPU, or back. No effect on a
// little-endian CPU.
constexpr void swap_host([[maybe_unused]] uint8_t* p, [[maybe_unused]] uint32_t n) {
  if constexpr (!host_is_little_endian) {
    for (uint32_t low = 0, high = n; low + 1 < high; ++low) {
      --high;
      const uint8_t kept = p[low];
      p[low] = p[high];
      p[high] = kept;
    }
  }
}

}  // namespace co::wire
