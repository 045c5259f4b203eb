// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// QEMU's xlnx-zcu102 without an operating system: a Cortex-A53, a GICv2 and the generic timer. Text and exit status
/// are passed to the host by semihosting.
#pragma once

#include <cstdint>

#include "co_if_timer.h"

namespace zynqmp {

/// Interrupt numbers. [UG1085]
constexpr unsigned can0_interrupt = 55;
constexpr unsigned can1_interrupt = 56;

/// Registers \a handler, which is called with \a ctx at each interrupt \a number.
void serve(unsigned number, void (*handler)(void* ctx), void* ctx);

/// Disables interrupts during its lifetime.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::uint64_t before_;
};

/// Sleeps until an interrupt is pending, also while a Quiet exists: then its handler runs after the Quiet's end.
void wait_for_interrupt();

/// Returns the microseconds since the start.
std::uint64_t micros();

/// Alarm of a node: the context argument of GenericTimerDriver. All alarms share one clock.
struct GenericTimer {
  void (*on_alarm)(void* ctx);  ///< called in the interrupt
  void* ctx;
  std::uint64_t due;  ///< time in micros(); 0: none
  GenericTimer* next;
};
/// Tickless timer driver: 1 tick is 1 µs.
extern const CO_IF_TIMER_DRV_EX GenericTimerDriver;
constexpr std::uint32_t ticks_per_second = 1000000;
/// Adds an alarm to the list of the interrupt. Must be called once for each alarm.
void add(GenericTimer& timer);

void print(const char* text);
void print(std::uint64_t number);

}  // namespace zynqmp
