// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// BBC micro:bit: nRF51822, a Cortex-M0 with 256 KiB of flash and 16 KiB of RAM.
#pragma once

#include <cstdint>

namespace board {

constexpr std::uint32_t core_hz = 16000000;  // SysTick counts it in QEMU; a real nRF51 has no SysTick

constexpr std::uintptr_t uart_base = 0x40002000;  // nRF51 UART0
constexpr unsigned uart_interrupts[] = {2};

constexpr std::uintptr_t timer_base = 0x40008000;  // nRF51 TIMER0: counts up, 32 bits, four compare registers
constexpr std::uint32_t timer_hz = 16000000;       // before its prescaler
constexpr unsigned timer_interrupt = 8;

}  // namespace board
