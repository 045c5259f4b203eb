// SPDX-License-Identifier: Apache-2.0
/// \file failing_nvm.hpp
/// A non-volatile memory with faults: loss of power, ignored writes, wrong bytes. A step is one programmed or erased
/// byte.
#pragma once

#include <cstdint>
#include <vector>

#include "co_if_nvm.h"

namespace test {

struct FailingNvm {
  /// Content of a byte whose write was interrupted.
  enum class PartialWrite : std::uint8_t { untouched, half, garbage, done };

  explicit FailingNvm(CO_NVM_SHAPE of) : shape(of), bytes(of.Capacity, 0xFF) {}

  CO_NVM_SHAPE shape;
  std::vector<std::uint8_t> bytes;
  std::uint64_t steps = 0;   ///< steps executed
  std::uint64_t cut_at = 0;  ///< step that is interrupted, from 1; 0: none. All later accesses fail
  PartialWrite partial_write = PartialWrite::untouched;
  bool is_off = false;
  std::uint64_t ignore_from = 0;  ///< steps ignore_from … ignore_to-1 have no effect and are reported as successful
  std::uint64_t ignore_to = 0;
  std::uint64_t reads = 0;
  std::uint64_t corrupt_read = 0;  ///< number of the read that returns wrong bytes, from 1; 0: none
  std::uint64_t refuse_read = 0;   ///< number of the read that fails, from 1; 0: none
  std::uint32_t torn_from = 0;     ///< bytes torn_from … torn_to-1 cannot be read (ECC); erasing them ends this
  std::uint32_t torn_to = 0;
  bool is_deaf = false;  ///< no byte can be read
  bool misused = false;  ///< an access has violated the geometry

  /// Restores the power.
  void power_up();

  static const CO_IF_NVM_DRV_EX driver;  ///< its context is a FailingNvm

 private:
  friend struct FailingNvmDriver;
  bool step(std::uint8_t& byte, std::uint8_t to);
  void check(std::uint32_t start, std::uint32_t size, std::uint32_t unit);
};

}  // namespace test
