// SPDX-License-Identifier: Apache-2.0
/// \file cpu.hpp
/// Interrupts of a Cortex-M.
#pragma once

#include <cstdint>

namespace board {

/// Disables interrupts. Returns the argument for restore_interrupts(); pairs of the two may be nested.
inline std::uint32_t disable_interrupts() {
  std::uint32_t mask;
  asm volatile("mrs %0, primask\n\tcpsid i" : "=r"(mask) : : "memory");
  return mask;
}

inline void restore_interrupts(std::uint32_t mask) { asm volatile("msr primask, %0" : : "r"(mask) : "memory"); }

inline void enable_interrupts() { asm volatile("cpsie i" : : : "memory"); }

/// Sleeps until an interrupt is pending. If interrupts are disabled, one that occurs between a check and the sleep ends
/// the sleep, and is handled when they are enabled again.
inline void wait_for_interrupt() { asm volatile("dsb\n\twfi" : : : "memory"); }

}  // namespace board
