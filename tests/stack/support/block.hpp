// SPDX-License-Identifier: Apache-2.0
/// \file block.hpp
/// CRC and range of blksize of block transfers, for simulated clients and servers. Derived from the standard.
#pragma once

#include <cstdint>
#include <vector>

namespace test {

/// Returns the CRC-16-CCITT with initial value 0, computed bit by bit. [301:7.2.4.3.16] [D14]
inline std::uint16_t crc_16(const std::vector<std::uint8_t>& data) {
  unsigned crc = 0;
  for (const std::uint8_t byte : data) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (unsigned bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ 0x1021U : crc << 1;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

constexpr bool is_blksize(std::uint8_t blksize) { return blksize >= 1 && blksize <= 127; }

}  // namespace test
