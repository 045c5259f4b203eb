// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// Arm MPS2 with the images AN385 (Cortex-M3) and AN386 (Cortex-M4): two times 4 MiB of SRAM, 16 MiB of PSRAM.
#pragma once

#include <cstdint>

namespace board {

constexpr std::uint32_t core_hz = 25000000;  // clock of SysTick

constexpr std::uintptr_t uart_base = 0x40004000;  // CMSDK UART0
constexpr unsigned uart_interrupts[] = {0, 1};    // received, sent

constexpr std::uintptr_t timer_base = 0x40000000;  // CMSDK TIMER0: counts down
constexpr std::uint32_t timer_hz = core_hz;
constexpr unsigned timer_interrupt = 8;

}  // namespace board
