// SPDX-License-Identifier: Apache-2.0
/// \file host.hpp
/// Bus and time of device and master: real ones, or simulated ones (VirtualBusHost, and hosts of tests).
#pragma once

#include <cstdint>
#include <string>

#include "co_core.h"

namespace lexican {

using Micros = std::uint64_t;  // microseconds
constexpr Micros millisecond = 1'000;
constexpr Micros second = 1'000'000;
constexpr Micros for_ever = UINT64_MAX;

/// A CAN controller: a driver and its context.
struct Can {
  const CO_IF_CAN_DRV_EX* driver;
  void* context;
};

struct Timer {
  const CO_IF_TIMER_DRV_EX* driver;
  void* context;
};

/// Non-volatile memory, or no driver.
struct Memory {
  const CO_IF_NVM_DRV_EX* driver = nullptr;
  void* context = nullptr;
};

class Host {
 public:
  virtual ~Host() = default;

  /// \name The two ends of the bus. Only those that the host was created for may be used.
  /// \{
  virtual Can device_can() = 0;
  virtual Timer device_timer() = 0;
  virtual Can master_can() = 0;
  virtual Timer master_timer() = 0;
  /// \}

  /// Returns a text for the fault of the bus; empty: none so far.
  virtual std::string bus_fault() { return {}; }
  /// Returns the number of frames that were lost before a node could read them: the driver's receive queue was full.
  virtual std::uint32_t lost_frames() { return 0; }
  /// Returns true if the bus is permanently lost.
  virtual bool bus_lost() { return false; }

  /// Returns the time since any epoch.
  virtual Micros now() = 0;
  /// Waits for at most \a time; ends earlier when a frame arrives or interrupted() becomes true.
  virtual void wait(Micros time) = 0;
  /// Returns true if the user has interrupted the program, or the bus is lost.
  virtual bool interrupted() = 0;
};

}  // namespace lexican
