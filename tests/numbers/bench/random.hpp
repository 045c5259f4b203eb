// SPDX-License-Identifier: Apache-2.0
/// \file random.hpp
/// Pseudo-random numbers, the same in each run.
#pragma once

#include <cstdint>

namespace bench {

/// Marsaglia's xorshift with 32 bits.
class Random {
 public:
  std::uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }
  /// Returns a number from 0 to \a end - 1.
  std::uint32_t below(std::uint32_t end) { return next() % end; }
  std::uint8_t byte() { return static_cast<std::uint8_t>(next() >> 11); }

 private:
  std::uint32_t state_ = 0x12345678u;
};

}  // namespace bench
