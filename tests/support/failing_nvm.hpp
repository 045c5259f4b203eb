// SPDX-License-Identifier: Apache-2.0
/// \file failing_nvm.hpp
/// A memory that fails at any step: it loses power, ignores writes or returns wrong bytes. A step is a programmed byte,
/// or an erased byte.
#pragma once

#include <cstdint>
#include <vector>

#include "co_if_nvm.h"

namespace test {

struct FailingNvm {
  /// Content of a byte whose write was interrupted.
  enum class Torn : std::uint8_t { untouched, half, garbage, done };

  explicit FailingNvm(CO_NVM_SHAPE of) : shape(of), bytes(of.Capacity, 0xFF) {}

  CO_NVM_SHAPE shape;
  std::vector<std::uint8_t> bytes;
  std::uint64_t steps = 0;   ///< steps executed
  std::uint64_t cut_at = 0;  ///< step that is interrupted, from 1; 0: none. All accesses after it fail
  Torn torn = Torn::untouched;
  bool is_off = false;
  std::uint64_t deaf_from = 0;  ///< steps deaf_from … deaf_to-1 have no effect and are reported as successful
  std::uint64_t deaf_to = 0;
  std::uint64_t reads = 0;
  std::uint64_t lie_at = 0;       ///< this read, from 1, returns other bytes
  std::uint64_t refuse_read = 0;  ///< this read fails
  bool misused = false;           ///< an access that the geometry does not allow

  /// Restores the power.
  void power_up();

  static const CO_IF_NVM_DRV_EX driver;  ///< its context is a FailingNvm

 private:
  friend struct FailingNvmDriver;
  bool step(std::uint8_t& byte, std::uint8_t to);
  void check(std::uint32_t start, std::uint32_t size, std::uint32_t unit);
};

}  // namespace test
