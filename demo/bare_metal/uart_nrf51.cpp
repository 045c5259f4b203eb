// SPDX-License-Identifier: Apache-2.0
// UART of the nRF51: a receive queue of six bytes, a transmit register of one byte.
#include "board.hpp"
#include "parts.hpp"

namespace lexican::demo {
namespace {

// Offsets of registers: tasks, events, settings and data of the UART.
constexpr std::uint32_t start_receiving = 0x000;
constexpr std::uint32_t start_sending = 0x008;
constexpr std::uint32_t received = 0x108;
constexpr std::uint32_t sent = 0x11C;
constexpr std::uint32_t failed = 0x124;
constexpr std::uint32_t interrupts_on = 0x304;
constexpr std::uint32_t error_source = 0x480;
constexpr std::uint32_t enable = 0x500;
constexpr std::uint32_t transmit_pin = 0x50C;
constexpr std::uint32_t receive_pin = 0x514;
constexpr std::uint32_t receive_data = 0x518;
constexpr std::uint32_t transmit_data = 0x51C;
constexpr std::uint32_t speed = 0x524;

constexpr std::uint32_t all_interrupts = 1u << 2 | 1u << 7 | 1u << 9;  // received, sent, failed
constexpr std::uint32_t enabled = 4;
constexpr std::uint32_t speed_115200 = 0x01D7E000;
static_assert(uart_speed == 115200);

bool sending = false;

volatile std::uint32_t& at(std::uint32_t offset) {
  return *reinterpret_cast<volatile std::uint32_t*>(board::uart_base + offset);
}

// Clears an event and returns true if it has occurred. It is not cleared otherwise, because it could occur between the
// two accesses; a received byte whose event is lost would block the queue.
bool take_event(std::uint32_t event) {
  if (at(event) == 0) {
    return false;
  }
  at(event) = 0;
  return true;
}

}  // namespace

void uart_begin() {
  at(transmit_pin) = 24;  // pins of the micro:bit
  at(receive_pin) = 25;
  at(speed) = speed_115200;
  at(enable) = enabled;
  at(interrupts_on) = all_interrupts;
  at(start_receiving) = 1;
  at(start_sending) = 1;
  board::enable_uart_interrupt();
}

void uart_send(CO_SLCAN& can) {
  const std::uint8_t* bytes = nullptr;
  if (!sending && COSlcanPending(&can, &bytes) != 0) {
    sending = true;
    at(transmit_data) = *bytes;
    COSlcanSent(&can, 1);
  }
}

void uart_interrupt(CO_SLCAN& can) {
  if (take_event(failed)) {
    at(error_source) = at(error_source);  // write 1 to clear
    COSlcanBroken(&can);
  }
  while (take_event(received)) {
    COSlcanReceive(&can, static_cast<std::uint8_t>(at(receive_data)));
  }
  if (take_event(sent)) {
    sending = false;
    uart_send(can);
  }
}

// Returns false while a byte is being sent: QEMU 7.2 omits the interrupt of a byte that the host did not accept at
// once, until a register is written.
bool uart_wakes_cpu() {
  if (sending) {
    at(interrupts_on) = all_interrupts;
  }
  return !sending;
}

}  // namespace lexican::demo
