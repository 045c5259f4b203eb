// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// Arm MPS2 board with the FPGA image AN385 (Cortex-M3) or AN386 (Cortex-M4): two SRAMs of 4 MiB, 16 MiB of PSRAM.
#pragma once

#include <cstdint>

namespace board {

constexpr std::uint32_t core_hz = 25000000;  // clock of SysTick

constexpr std::uintptr_t uart_base = 0x40004000;  // CMSDK UART0
constexpr unsigned uart_interrupts[] = {0, 1};    // numbers of its receive and its transmit interrupt

constexpr std::uintptr_t timer_base = 0x40000000;  // CMSDK TIMER0: counts down
constexpr std::uint32_t timer_hz = core_hz;
constexpr unsigned timer_interrupt = 8;

}  // namespace board
