// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// QEMU's xlnx-zcu102 without an operating system: a Cortex-A53, a GICv2, the generic timer, and the host that is asked
/// for text and exit by semihosting.
#pragma once

#include <cstdint>

#include "co_if_timer.h"

namespace zynqmp {

/// Numbers of interrupts. [UG1085]
constexpr unsigned can0_interrupt = 55;
constexpr unsigned can1_interrupt = 56;

/// Lets \a handler be called with \a ctx whenever the interrupt \a number comes.
void serve(unsigned number, void (*handler)(void* ctx), void* ctx);

/// While one lives, no interrupt is served.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::uint64_t before_;
};

/// Sleeps until an interrupt comes, also while there is a Quiet: it is served behind that.
void wait_for_interrupt();

/// Microseconds since the start.
std::uint64_t micros();

/// An alarm, of as many as are needed, on the one clock: the context of GenericTimerDriver.
struct GenericTimer {
  void (*on_alarm)(void* ctx);  ///< in the interrupt
  void* ctx;
  std::uint64_t due;  ///< in micros(); 0: none
  GenericTimer* next;
};
/// A driver for the timers of a node, tickless: 1 tick is 1 µs.
extern const CO_IF_TIMER_DRV_EX GenericTimerDriver;
constexpr std::uint32_t ticks_per_second = 1000000;
/// Makes the alarm known to the interrupt, once.
void add(GenericTimer& timer);

void print(const char* text);
void print(std::uint64_t number);

}  // namespace zynqmp
