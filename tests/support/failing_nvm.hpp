// SPDX-License-Identifier: Apache-2.0
/// \file failing_nvm.hpp
/// A memory that loses its power, or its mind, at any step. A step is a byte that is programmed, or a byte that is
/// erased.
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
  std::uint64_t steps = 0;   ///< so far
  std::uint64_t cut_at = 0;  ///< the step that is interrupted, from 1; 0: none. Afterwards nothing works
  Torn torn = Torn::untouched;
  bool is_off = false;
  std::uint64_t deaf_from = 0;  ///< steps deaf_from … deaf_to-1 have no effect and are reported as done
  std::uint64_t deaf_to = 0;
  std::uint64_t reads = 0;
  std::uint64_t lie_at = 0;       ///< this read, from 1, returns other bytes
  std::uint64_t refuse_read = 0;  ///< this read fails
  bool misused = false;           ///< an access that the shape does not allow

  /// Power is back.
  void power_up();

  static const CO_IF_NVM_DRV_EX driver;  ///< its context is a FailingNvm

 private:
  friend struct FailingNvmDriver;
  bool step(std::uint8_t& byte, std::uint8_t to);
  void check(std::uint32_t start, std::uint32_t size, std::uint32_t unit);
};

}  // namespace test
