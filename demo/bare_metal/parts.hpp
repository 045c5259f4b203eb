// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// Parts of the board besides the CPU: a UART, in place of a CAN controller, and a timer. There is one file for each
/// type of UART and timer; CMakeLists.txt selects those of the board.
#pragma once

#include <cstdint>

#include "co_if_timer.h"
#include "co_slcan.h"

namespace lexican::demo {

/// Initialises the UART, 115200 bit/s, 8 data bits, no parity, and enables its interrupt.
void uart_begin();
/// Starts the transmission of pending text. Call it with interrupts disabled.
void uart_send(CO_SLCAN& can);
/// Handles the interrupt of the UART.
void uart_interrupt(CO_SLCAN& can);

/// Returns true if the UART will interrupt, so that the CPU may sleep.
bool uart_wakes_cpu();

/// Timer driver with its context, for CO_NODE_EXT.
struct BoardTimer {
  const CO_IF_TIMER_DRV_EX* driver;
  void* context;
};

/// Returns the timer of the board. Enables its interrupt if it is not part of the CPU; the driver enables that of
/// SysTick.
BoardTimer board_timer();
/// Handles the interrupt of the timer. Call it before COTmrService().
void timer_interrupt();

constexpr std::uint32_t uart_speed = 115200;  // bit/s

}  // namespace lexican::demo
