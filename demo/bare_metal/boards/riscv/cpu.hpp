// SPDX-License-Identifier: Apache-2.0
/// \file cpu.hpp
/// Interrupts of a RISC-V hart in machine mode.
#pragma once

#include <cstdint>

namespace board {

/// Disables interrupts: clears MIE, bit 3 of mstatus. Returns the argument for restore_interrupts(); pairs of the two
/// may be nested.
inline std::uint32_t disable_interrupts() {
  std::uint32_t status;
  asm volatile("csrrci %0, mstatus, 8" : "=r"(status) : : "memory");
  return status & 8u;
}

inline void restore_interrupts(std::uint32_t enabled) { asm volatile("csrs mstatus, %0" : : "r"(enabled) : "memory"); }

inline void enable_interrupts() { asm volatile("csrsi mstatus, 8" : : : "memory"); }

/// Sleeps until an interrupt is pending. If interrupts are disabled, one that occurs between a check and the sleep ends
/// the sleep, and is handled when they are enabled again.
inline void wait_for_interrupt() { asm volatile("wfi" : : : "memory"); }

}  // namespace board
