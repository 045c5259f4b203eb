// SPDX-License-Identifier: Apache-2.0
// UART of Arm's Cortex-M System Design Kit: a register of one byte in each direction.
#include "board.hpp"
#include "parts.hpp"

namespace lexican::demo {
namespace {

struct Registers {
  volatile std::uint32_t data;
  volatile std::uint32_t state;
  volatile std::uint32_t control;
  volatile std::uint32_t interrupts;  // write 1 to clear
  volatile std::uint32_t divisor;
};

constexpr std::uint32_t transmit_full = 1u << 0;    // bit of state
constexpr std::uint32_t receive_full = 1u << 1;     // bit of state
constexpr std::uint32_t receive_overrun = 1u << 3;  // bit of state; write 1 to clear
constexpr std::uint32_t enable_all = 0xFu;          // bits of control: both directions, with their interrupts
constexpr std::uint32_t both_interrupts = 0x3u;

Registers& uart() { return *reinterpret_cast<Registers*>(board::uart_base); }

}  // namespace

void uart_begin() {
  uart().divisor = board::core_hz / uart_speed;
  uart().control = enable_all;
  board::enable_uart_interrupt();
}

void uart_send(CO_SLCAN& can) {
  const std::uint8_t* bytes = nullptr;
  while ((uart().state & transmit_full) == 0 && COSlcanPending(&can, &bytes) != 0) {
    uart().data = *bytes;
    COSlcanSent(&can, 1);
  }
}

void uart_interrupt(CO_SLCAN& can) {
  uart().interrupts = both_interrupts;
  if ((uart().state & receive_overrun) != 0) {
    uart().state = receive_overrun;
    COSlcanBroken(&can);
  }
  while ((uart().state & receive_full) != 0) {
    COSlcanReceive(&can, static_cast<std::uint8_t>(uart().data));
  }
  uart_send(can);
}

bool uart_wakes_cpu() { return true; }

}  // namespace lexican::demo
