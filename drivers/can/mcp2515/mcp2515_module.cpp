// SPDX-License-Identifier: Apache-2.0
// SPI instructions, filters and modes.
#include "../transmit.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

// Writes neighbouring filters or masks.
void write_words(const Can& can, unsigned address, const std::uint32_t* words, unsigned number) {
  std::uint8_t bytes[2 + 3 * 4] = {CO_MCP2515_WRITE, static_cast<std::uint8_t>(address)};
  std::uint8_t* next = bytes + 2;
  for (unsigned n = 0; n < number; ++n, next += 4) {
    put_word(words[n], next);
  }
  transact(can, bytes, 2 + 4 * number);
}

bool await_configuration(const Can& can) {
  unsigned left = status_reads;
  while (left != 0 && (read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE) != CO_MCP2515_MODE_CONFIGURATION) {
    --left;
  }
  return left != 0;
}

}  // namespace

std::uint32_t instruct(const Can& can, std::uint32_t word, unsigned number) {
  std::uint8_t bytes[4];
  transmit::unpack(word, bytes);
  transact(can, bytes, number);
  return transmit::word_at(bytes);
}

void write_control(const Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANCTRL, bits | (can.ClockOutput & CO_MCP2515_CLOCK_OUTPUT));
}

void enable_interrupts(Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANINTE, bits);
  can.Enabled = static_cast<std::uint8_t>(bits);
}

void put_word(std::uint32_t word, std::uint8_t* bytes) {
  const unsigned extended = (word & extended_bit) != 0 ? CO_MCP2515_SIDL_EXIDE : 0;
  bytes[0] = static_cast<std::uint8_t>(word >> 21);
  bytes[1] = static_cast<std::uint8_t>((word >> 13 & 0xE0) | extended | (word >> 16 & 0x03));
  bytes[2] = static_cast<std::uint8_t>(word >> 8);
  bytes[3] = static_cast<std::uint8_t>(word);
}

void reset_controller(const Can& can) {
  static_cast<void>(instruct(can, CO_MCP2515_RESET, 1));
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
  can.IsAborting = 0;
  transmit::take_back(can.Transmit);
}

bool write_configuration(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  std::uint8_t timing[] = {CO_MCP2515_WRITE, CO_MCP2515_CNF3, 0, 0, 0, 0};  // CNF3, CNF2, CNF1, and one byte to read
  transmit::unpack(rate.Timing, timing + 2);
  transact(can, timing, 5);
  timing[0] = CO_MCP2515_READ;
  timing[1] = CO_MCP2515_CNF3;
  transact(can, timing, sizeof timing);
  write(can, CO_MCP2515_RXCTRL(0), CO_MCP2515_RXCTRL_BUKT);
  write(can, CO_MCP2515_RXCTRL(1), 0);
  write_words(can, CO_MCP2515_FILTERS, can.Filters.Word, 3);
  write_words(can, CO_MCP2515_FILTERS3, can.Filters.Word + 3, 3);
  write_words(can, CO_MCP2515_MASKS, can.Filters.Mask, receive_buffers);
  enable_interrupts(can, all_interrupts);
  can.NeedsFilters = 0;
  return ((rate.Timing ^ transmit::word_at(timing + 2)) & 0xFFFFFF) == 0;
}

}  // namespace co::mcp2515
