// SPDX-License-Identifier: Apache-2.0
/// \file bus_fault.hpp
/// Faults of the bus of a modelled EEPROM, at a given access: a transfer on I2C, or a selection of the device on SPI.
/// The tests sweep over all accesses, kinds and durations.
///
///     memory.bus_fault = {BusFault::half, 3, 1};  // only the third access after this line is faulty
///     memory.bus_fault = {};                      // no fault
#pragma once

#include <cstdint>

namespace test {

enum class BusFault : std::uint8_t {
  absent,         ///< the device does not take part: no acknowledge, or it reads FFh
  absent_low,     ///< the device does not take part; on SPI it reads 00h
  half,           ///< the device is lost in the middle of the access and does not execute it
  half_executed,  ///< the transfer ends in the middle, and the device executes what it has received
  executed,       ///< the device executes the access, but the bus reports an error; on SPI the device reads FFh
  executed_low,   ///< like executed; on SPI the device reads 00h
  reads_ff,       ///< a read returns FFh without an error; a write is not acknowledged
  half_reads_ff,  ///< the second half of a read returns FFh without an error; a write is like half
};

constexpr BusFault all_bus_faults[] = {BusFault::absent,        BusFault::absent_low,   BusFault::half,
                                       BusFault::half_executed, BusFault::executed,     BusFault::executed_low,
                                       BusFault::reads_ff,      BusFault::half_reads_ff};

/// Numbers of faulty accesses: one, some, and all until the test clears the fault.
constexpr std::uint64_t lasting = UINT64_MAX;
constexpr std::uint64_t fault_durations[] = {1, 3, lasting};

struct BusFaults {
  BusFault kind = BusFault::absent;
  std::uint64_t at = 0;        ///< first faulty access, from 1; 0: none
  std::uint64_t duration = 1;  ///< number of faulty accesses
  std::uint64_t accesses = 0;  ///< accesses begun

  /// Begins an access. Returns whether it is faulty.
  bool begins() {
    ++accesses;
    return at != 0 && accesses >= at && accesses - at < duration;
  }
  /// Returns whether the present access is the first faulty one.
  [[nodiscard]] bool is_first() const { return accesses == at; }
  /// Returns whether the first faulty access was begun.
  [[nodiscard]] bool has_begun() const { return at != 0 && accesses >= at; }
};

/// Calls function(kind, duration) for each kind and duration of a fault.
template <class Function>
void for_bus_faults(Function function) {
  for (const BusFault kind : all_bus_faults) {
    for (const std::uint64_t duration : fault_durations) {
      function(kind, duration);
    }
  }
}

}  // namespace test
