// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// QEMU's RISC-V machine "virt" with one rv32 hart, without firmware.
#pragma once

#include <cstdint>

namespace board {

constexpr std::uintptr_t uart_base = 0x10000000;  // 16550, registers of one byte side by side
constexpr unsigned uart_interrupts[] = {10};      // of the PLIC

constexpr std::uintptr_t timer_base = 0x02000000;  // CLINT: mtimecmp at 4000h, mtime at BFF8h, 64 bits each
constexpr std::uint32_t timer_hz = 10000000;

constexpr std::uintptr_t interrupt_controller_base = 0x0C000000;  // PLIC; context 0 is that of machine mode

}  // namespace board
