// SPDX-License-Identifier: Apache-2.0
// SPI instructions, filters and modes.
#include "../transmit.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

// Writes neighbouring filters or masks.
void write_words(const Can& can, unsigned address, const std::uint32_t* words, unsigned number) {
  for (unsigned n = 0; n < number; ++n) {
    std::uint8_t bytes[6] = {CO_MCP2515_WRITE, static_cast<std::uint8_t>(address + 4 * n)};
    put_word(words[n], bytes + 2);
    transact(can, bytes);
  }
}

bool await_configuration(const Can& can) {
  unsigned left = status_reads;
  while (left != 0 && (read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE) != CO_MCP2515_MODE_CONFIGURATION) {
    --left;
  }
  return left != 0;
}

}  // namespace

std::uint8_t read(const Can& can, unsigned address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, static_cast<std::uint8_t>(address), 0};
  transact(can, bytes);
  return bytes[2];
}

TwoRegisters read_two(const Can& can, unsigned address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, static_cast<std::uint8_t>(address), 0, 0};
  transact(can, bytes);
  return {bytes[2], bytes[3]};
}

std::uint8_t read_status(const Can& can) {
  std::uint8_t bytes[] = {CO_MCP2515_READ_STATUS, 0};
  transact(can, bytes);
  return bytes[1];
}

void write(const Can& can, unsigned address, unsigned value) {
  std::uint8_t bytes[] = {CO_MCP2515_WRITE, static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(value)};
  transact(can, bytes);
}

void clear_bits(const Can& can, unsigned address, unsigned bits) {
  std::uint8_t bytes[] = {CO_MCP2515_BIT_MODIFY, static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(bits),
                          0};
  transact(can, bytes);
}

void command(const Can& can, unsigned instruction) {
  std::uint8_t bytes[] = {static_cast<std::uint8_t>(instruction)};
  transact(can, bytes);
}

void write_control(const Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANCTRL, bits | (can.ClockOutput & CO_MCP2515_CLOCK_OUTPUT));
}

void enable_interrupts(Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANINTE, bits);
  can.State.Enabled = static_cast<std::uint8_t>(bits);
}

void put_word(std::uint32_t word, std::uint8_t* bytes) {
  const unsigned extended = (word & extended_bit) != 0 ? CO_MCP2515_SIDL_EXIDE : 0;
  bytes[0] = static_cast<std::uint8_t>(word >> 21);
  bytes[1] = static_cast<std::uint8_t>((word >> 13 & 0xE0) | extended | (word >> 16 & 0x03));
  bytes[2] = static_cast<std::uint8_t>(word >> 8);
  bytes[3] = static_cast<std::uint8_t>(word);
}

void reset_controller(const Can& can) {
  command(can, CO_MCP2515_RESET);
  static_cast<void>(await_configuration(can));
  write_control(can, CO_MCP2515_MODE_CONFIGURATION);
}

void enter_configuration(Can& can) {
  const unsigned mode = read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE;
  if (mode == CO_MCP2515_MODE_NORMAL || mode == CO_MCP2515_MODE_LOOPBACK) {
    await_idle_buffers(can);
  }
  write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  if (!await_configuration(can)) {
    reset_controller(can);
  }
  can.State.IsAborting = 0;
  transmit::take_back(can.State.Transmit);
}

bool write_configuration(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  std::uint8_t timing[] = {CO_MCP2515_WRITE, CO_MCP2515_CNF3, static_cast<std::uint8_t>(rate.Timing),
                           static_cast<std::uint8_t>(rate.Timing >> 8), static_cast<std::uint8_t>(rate.Timing >> 16)};
  transact(can, timing);
  std::uint8_t present[] = {CO_MCP2515_READ, CO_MCP2515_CNF3, 0, 0, 0, 0};  // CNF3, CNF2, CNF1, and one byte more
  transact(can, present);
  write(can, CO_MCP2515_RXCTRL(0), CO_MCP2515_RXCTRL_BUKT);
  write(can, CO_MCP2515_RXCTRL(1), 0);
  write_words(can, CO_MCP2515_FILTERS, can.State.Filters.Word, 3);
  write_words(can, CO_MCP2515_FILTERS3, can.State.Filters.Word + 3, 3);
  write_words(can, CO_MCP2515_MASKS, can.State.Filters.Mask, receive_buffers);
  enable_interrupts(can, all_interrupts);
  can.State.NeedsFilters = 0;
  return ((rate.Timing ^ transmit::word_at(present + 2)) & 0xFFFFFF) == 0;
}

}  // namespace co::mcp2515
