// SPDX-License-Identifier: Apache-2.0
// SPI instructions, filters and modes.
#include "../transmit.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

// Limit of loops: the frame on the wire has to end before the controller goes off the bus.
constexpr unsigned status_reads = 20000;

// Writes neighbouring filters or masks.
void write_words(const Can& can, unsigned address, const std::uint32_t* words, unsigned number) {
  for (unsigned n = 0; n < number; ++n) {
    const std::uint32_t word = words[n];
    std::uint8_t bytes[] = {CO_MCP2515_WRITE,
                            static_cast<std::uint8_t>(address + 4 * n),
                            static_cast<std::uint8_t>(word >> 21),
                            static_cast<std::uint8_t>((word >> 13 & 0xE0) | (word >> 16 & 0x03) |
                                                      ((word & extended_bit) != 0 ? CO_MCP2515_SIDL_EXIDE : 0)),
                            static_cast<std::uint8_t>(word >> 8),
                            static_cast<std::uint8_t>(word)};
    transact(can, bytes);
  }
}

}  // namespace

std::uint8_t read(const Can& can, std::uint8_t address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, address, 0};
  transact(can, bytes);
  return bytes[2];
}

TwoRegisters read_two(const Can& can, std::uint8_t address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, address, 0, 0};
  transact(can, bytes);
  return {bytes[2], bytes[3]};
}

std::uint8_t read_status(const Can& can) {
  std::uint8_t bytes[] = {CO_MCP2515_READ_STATUS, 0};
  transact(can, bytes);
  return bytes[1];
}

void write(const Can& can, std::uint8_t address, unsigned value) {
  std::uint8_t bytes[] = {CO_MCP2515_WRITE, address, static_cast<std::uint8_t>(value)};
  transact(can, bytes);
}

void clear_bits(const Can& can, std::uint8_t address, unsigned bits) {
  std::uint8_t bytes[] = {CO_MCP2515_BIT_MODIFY, address, static_cast<std::uint8_t>(bits), 0};
  transact(can, bytes);
}

void command(const Can& can, unsigned instruction) {
  std::uint8_t bytes[] = {static_cast<std::uint8_t>(instruction)};
  transact(can, bytes);
}

void write_control(const Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANCTRL, bits | (can.ClockOutput & CO_MCP2515_CLOCK_OUTPUT));
}

bool await_configuration(const Can& can) {
  unsigned left = status_reads;
  while (left != 0 && (read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE) != CO_MCP2515_MODE_CONFIGURATION) {
    --left;
  }
  return left != 0;
}

void enter_configuration(Can& can) {
  const unsigned mode = read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE;
  if (mode == CO_MCP2515_MODE_NORMAL || mode == CO_MCP2515_MODE_LOOPBACK) {
    await_idle_buffers(can);
  }
  write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  if (!await_configuration(can)) {
    command(can, CO_MCP2515_RESET);
    static_cast<void>(await_configuration(can));
    write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  }
  can.State.IsAborting = 0;
  transmit::take_back(can.State.Transmit);
}

bool write_configuration(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  std::uint8_t timing[] = {CO_MCP2515_WRITE, CO_MCP2515_CNF3, static_cast<std::uint8_t>(rate.Timing),
                           static_cast<std::uint8_t>(rate.Timing >> 8), static_cast<std::uint8_t>(rate.Timing >> 16)};
  const std::uint8_t written[] = {timing[2], timing[3], timing[4]};
  transact(can, timing);
  std::uint8_t present[] = {CO_MCP2515_READ, CO_MCP2515_CNF3, 0, 0, 0};
  transact(can, present);
  write(can, static_cast<std::uint8_t>(CO_MCP2515_RXCTRL(0)), CO_MCP2515_RXCTRL_BUKT);
  write(can, static_cast<std::uint8_t>(CO_MCP2515_RXCTRL(1)), 0);
  write_words(can, CO_MCP2515_FILTERS, can.State.FilterWord, 3);
  write_words(can, CO_MCP2515_FILTERS3, can.State.FilterWord + 3, 3);
  write_words(can, CO_MCP2515_MASKS, can.State.FilterMask, receive_buffers);
  write(can, CO_MCP2515_CANINTE, all_interrupts);
  can.State.IsErrorMasked = 0;
  can.State.NeedsFilters = 0;
  return present[2] == written[0] && present[3] == written[1] && present[4] == written[2];
}

void leave_configuration(const Can& can) {
  write_control(can, can.Loopback ? CO_MCP2515_MODE_LOOPBACK : CO_MCP2515_MODE_NORMAL);
}

}  // namespace co::mcp2515
