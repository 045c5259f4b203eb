// SPDX-License-Identifier: Apache-2.0
// CRC-32 of records in non-volatile memory: polynomial 04C11DB7h, reflected. Small code rather than fast code: the
// memory is slower.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace co::wire {

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
