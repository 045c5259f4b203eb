// SPDX-License-Identifier: Apache-2.0
/// \file board.hpp
/// Board support functions for a program without an operating system. The boards are machines of QEMU. boards.cmake
/// adds the directories of one board to the include path, so machine.hpp and cpu.hpp are those of that board.
#pragma once

#include "cpu.hpp"
#include "machine.hpp"

namespace board {

/// Interrupt handlers, defined by the program: of the timer and of the UART in machine.hpp. An interrupt without a
/// handler ends the program like a fault.
void on_timer();
void on_uart();

/// Enable the interrupt of the UART, or of a timer that is not part of the CPU, in the interrupt controller.
void enable_uart_interrupt();
void enable_timer_interrupt();

/// Print on the terminal of the host (semihosting).
void print(const char* text);
void print_hex(std::uint32_t number);

/// Ends QEMU; \a status becomes its exit status.
[[noreturn]] void leave(int status);

}  // namespace board
