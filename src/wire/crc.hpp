// SPDX-License-Identifier: Apache-2.0
// CRC-16-CCITT: x^16 + x^12 + x^5 + 1, start value 0. [301:7.2.4.3.16]
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace co::wire {

// Returns the CRC after up to 32 data bits. x: the data bits; the CRC of the data before them is XORed to the first 16.
//
// Derivation, with the bits of x as a polynomial p over GF(2), z the variable and G = z^16 + z^12 + z^5 + 1: the CRC is
// p * z^16 modulo G. Because z^16 = z^12 + z^5 + 1 modulo G, it is p * (z^12 + z^5 + 1); the bits of this product from
// bit 16 on are g(p) = p >> 4 ^ p >> 11 ^ p >> 16, which are reduced in the same way. So the CRC is the lowest 16 bits
// of (z^12 + z^5 + 1) times the sum p + g(p) + g(g(p)) + ..., in which g applied 8 times gives 0. The sum is (1 + g)(1
// + g^2)(1 + g^4) applied to p. Mixed terms cancel over GF(2): g^2 is >> 8 ^ >> 22 (>> 32 gives 0), and g^4 is >> 16.
[[gnu::always_inline]] constexpr uint32_t crc16_of(uint32_t x) {
  x ^= x >> 16;
  x ^= (x >> 8) ^ (x >> 22);
  x ^= (x >> 4) ^ (x >> 11) ^ (x >> 16);
  return x ^ (x << 5) ^ (x << 12);  // in bits 15...0
}

// Returns the CRC after n more bytes of data. Processes four bytes at a time, without a table.
[[gnu::noinline]] constexpr uint16_t crc16(uint16_t crc, const uint8_t* data, uint32_t n) {
  uint32_t sum = crc;
  const uint8_t* const words_end = data + (n & ~3U);
  const uint8_t* const end = data + n;
  for (; data != words_end; data += 4) {
    const uint32_t word = (static_cast<uint32_t>(data[0]) << 24) | (static_cast<uint32_t>(data[1]) << 16) |
                          (static_cast<uint32_t>(data[2]) << 8) | data[3];
    sum = crc16_of((sum << 16) ^ word);
  }
  for (; data != end; ++data) {
    sum = (sum << 8) ^ crc16_of(((sum >> 8) & 0xFFU) ^ *data);
  }
  return static_cast<uint16_t>(sum);
}

namespace vectors {
inline constexpr uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
static_assert(crc16(0, digits, sizeof digits) == 0x31C3);
static_assert(crc16(crc16(0, digits, 4), digits + 4, 5) == 0x31C3);
static_assert(crc16(crc16(0, digits, 3), digits + 3, 6) == 0x31C3);
}  // namespace vectors

// CRC-32 of records in non-volatile memory: polynomial 04C11DB7h, reflected. Small code rather than fast code: the
// memory is slower.

class Crc32 {
 public:
  constexpr void add(const uint8_t* bytes, size_t num) {
    constexpr uint32_t reflected = 0xEDB88320;
    for (size_t n = 0; n < num; ++n) {
      remainder_ ^= bytes[n];
      for (unsigned bit = 0; bit < 8; ++bit) {
        remainder_ = (remainder_ >> 1) ^ ((remainder_ & 1U) != 0 ? reflected : 0);
      }
    }
  }

  [[nodiscard]] constexpr uint32_t value() const { return ~remainder_; }

 private:
  uint32_t remainder_ = UINT32_MAX;
};

constexpr uint32_t crc32_of_check() {
  constexpr uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  Crc32 crc;
  crc.add(digits, sizeof digits);
  return crc.value();
}
static_assert(crc32_of_check() == 0xCBF43926);

}  // namespace co::wire
