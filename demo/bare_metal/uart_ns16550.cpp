// SPDX-License-Identifier: Apache-2.0
// UART 16550: queues of 16 bytes in both directions.
#include "board.hpp"
#include "parts.hpp"

namespace lexican::demo {
namespace {

// Offsets of registers.
constexpr std::uint32_t data = 0;
constexpr std::uint32_t interrupts = 1;
constexpr std::uint32_t queues = 2;
constexpr std::uint32_t line_control = 3;
constexpr std::uint32_t line_status = 5;
constexpr std::uint32_t divisor_low = 0;   // while divisor_access is set in line_control
constexpr std::uint32_t divisor_high = 1;  // while divisor_access is set in line_control

constexpr std::uint8_t receive_interrupt = 1u << 0;
constexpr std::uint8_t transmit_interrupt = 1u << 1;
constexpr std::uint8_t empty_queues = 0x07;  // clears and enables the queues, with an interrupt for each byte
constexpr std::uint8_t eight_bits = 0x03;
constexpr std::uint8_t divisor_access = 0x80;
constexpr std::uint8_t has_data = 1u << 0;
constexpr std::uint8_t has_lost_data = 1u << 1;
constexpr std::uint8_t can_send = 1u << 5;  // the transmit queue is empty

constexpr unsigned queue_length = 16;
constexpr std::uint32_t clock_hz = 3686400;

volatile std::uint8_t& at(std::uint32_t offset) {
  return *reinterpret_cast<volatile std::uint8_t*>(board::uart_base + offset);
}

}  // namespace

void uart_begin() {
  constexpr std::uint32_t divisor = clock_hz / 16 / uart_speed;
  at(line_control) = eight_bits | divisor_access;
  at(divisor_low) = static_cast<std::uint8_t>(divisor);
  at(divisor_high) = static_cast<std::uint8_t>(divisor >> 8);
  at(line_control) = eight_bits;
  at(queues) = empty_queues;
  at(interrupts) = receive_interrupt;
  board::enable_uart_interrupt();
}

// Enables the transmit interrupt while the driver has text to send. The interrupt is active as long as the transmit
// queue is empty: uart_interrupt() fills it.
void uart_send(CO_SLCAN& can) {
  const std::uint8_t* bytes = nullptr;
  const bool has_text = COSlcanPending(&can, &bytes) != 0;
  at(interrupts) = has_text ? receive_interrupt | transmit_interrupt : receive_interrupt;
}

void uart_interrupt(CO_SLCAN& can) {
  std::uint8_t status = at(line_status);
  for (; (status & has_data) != 0; status = at(line_status)) {
    if ((status & has_lost_data) != 0) {
      COSlcanBroken(&can);
    }
    COSlcanReceive(&can, at(data));
  }
  const std::uint8_t* bytes = nullptr;
  for (unsigned room = (status & can_send) != 0 ? queue_length : 0; room != 0 && COSlcanPending(&can, &bytes) != 0;
       --room) {
    at(data) = *bytes;
    COSlcanSent(&can, 1);
  }
  uart_send(can);
}

bool uart_wakes_cpu() { return true; }

}  // namespace lexican::demo
