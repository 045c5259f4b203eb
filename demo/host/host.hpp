// SPDX-License-Identifier: Apache-2.0
/// \file host.hpp
/// The bus and the time in which device and master live: real ones, or simulated ones in tests.
#pragma once

#include <cstdint>
#include <string>

#include "co_core.h"

namespace demo {

using Micros = std::uint64_t;
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

/// Memory that survives a loss of power, or no driver.
struct Memory {
  const CO_IF_NVM_DRV_EX* driver = nullptr;
  void* context = nullptr;
};

class Host {
 public:
  virtual ~Host() = default;

  /// \name The two ends of the bus. Only those may be used that the host was made for.
  /// \{
  virtual Can device_can() = 0;
  virtual Timer device_timer() = 0;
  virtual Can master_can() = 0;
  virtual Timer master_timer() = 0;
  /// \}

  /// What is wrong with the bus, in words; empty: nothing so far.
  virtual std::string bus_fault() { return {}; }
  /// Whether it is gone for good.
  virtual bool bus_lost() { return false; }

  /// Time since any moment.
  virtual Micros now() = 0;
  /// Lets at most \a time pass; ends sooner when a frame arrives or interrupted() becomes true.
  virtual void wait(Micros time) = 0;
  /// Whether somebody wants the program to end, or the bus is lost.
  virtual bool interrupted() = 0;
};

}  // namespace demo
