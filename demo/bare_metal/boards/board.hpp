// SPDX-License-Identifier: Apache-2.0
/// \file board.hpp
/// What a program without an operating system knows of its board, and may ask of it. The boards are machines of QEMU;
/// machine.hpp and cpu.hpp are those of the board that the program is linked for (boards.cmake).
#pragma once

#include "cpu.hpp"
#include "machine.hpp"

namespace board {

/// The program's interrupt handlers, of the timer and of the UART that machine.hpp names. An interrupt whose handler
/// the program does not define ends it as a fault does.
void on_timer();
void on_uart();

/// Lets interrupts of the UART, or of a timer that is not part of the CPU, come to the CPU.
void enable_uart_interrupt();
void enable_timer_interrupt();

/// On the terminal of the host (semihosting).
void print(const char* text);
void print_hex(std::uint32_t number);

/// Ends QEMU with this status.
[[noreturn]] void leave(int status);

}  // namespace board
