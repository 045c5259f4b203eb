// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// What the demo uses of its board besides the CPU: a UART, which stands for a CAN controller, and a timer. One file
/// for each kind, of which the board has one (CMakeLists.txt).
#pragma once

#include <cstdint>

#include "co_if_timer.h"
#include "co_slcan.h"

namespace demo {

/// 115200 bit/s, 8 data bits, no parity; from now on it interrupts.
void uart_begin();
/// There is text to be sent. Called with interrupts kept away.
void uart_send(CO_SLCAN& can);
/// To be called in its interrupt.
void uart_interrupt(CO_SLCAN& can);

/// Whether the CPU may sleep as far as the UART is concerned: false while it cannot be relied on to interrupt.
bool uart_lets_sleep();

struct BoardTimer {
  const CO_IF_TIMER_DRV_EX* driver;
  void* context;
};

BoardTimer board_timer();
/// To be called in its interrupt, before COTmrService().
void timer_interrupt();

constexpr std::uint32_t uart_speed = 115200;  // bit/s

}  // namespace demo
