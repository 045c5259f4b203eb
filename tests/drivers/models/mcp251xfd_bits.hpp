// SPDX-License-Identifier: Apache-2.0
/// \file mcp251xfd_bits.hpp
/// Addresses and bits of the registers of MCP2517FD and MCP2518FD, for the sources of the model.
#pragma once

#include <cstddef>
#include <cstdint>

#include "can_frame.hpp"

namespace test {
namespace mcp251xfd {

constexpr std::uint32_t bit(unsigned number) { return 1U << number; }

// Registers
constexpr unsigned con = 0x000;
constexpr unsigned nbtcfg = 0x004;
constexpr unsigned dbtcfg = 0x008;
constexpr unsigned tdc = 0x00C;
constexpr unsigned tscon = 0x014;
constexpr unsigned vec = 0x018;
constexpr unsigned interrupts = 0x01C;
constexpr unsigned rxif = 0x020;
constexpr unsigned txif = 0x024;
constexpr unsigned rxovif = 0x028;
constexpr unsigned txatif = 0x02C;
constexpr unsigned txreq_register = 0x030;
constexpr unsigned trec = 0x034;
constexpr unsigned bdiag0 = 0x038;
constexpr unsigned bdiag1 = 0x03C;
constexpr unsigned tefcon = 0x040;
constexpr unsigned first_reserved = 0x04C;
constexpr unsigned txqcon = 0x050;
constexpr unsigned fltcon = 0x1D0;
constexpr unsigned fltobj = 0x1F0;
constexpr unsigned registers_end = 0x2F0;
constexpr unsigned chip_begin = 0xE00;
constexpr unsigned osc = 0xE00;
constexpr unsigned iocon = 0xE04;
constexpr unsigned crc = 0xE08;
constexpr unsigned ecccon = 0xE0C;
constexpr unsigned devid = 0xE14;
constexpr unsigned chip_end = 0xE18;
constexpr unsigned fifo_bytes = 12;  // registers of a FIFO

// C1CON
constexpr std::uint32_t con_at_reset = 0x04180760;  // without OPMOD
constexpr std::uint32_t con_writable = 0xFF1F177F;
constexpr std::uint32_t con_protected = 0x001F0160;
constexpr std::uint32_t abat = bit(27);
constexpr std::uint32_t txqen = bit(20);
constexpr std::uint32_t stef = bit(19);
constexpr std::uint32_t serr2lom = bit(18);
constexpr std::uint32_t rtxat = bit(16);
constexpr std::uint32_t busy = bit(11);

// C1INT
constexpr std::uint32_t modif = bit(3);
constexpr std::uint32_t serrif = bit(12);
constexpr std::uint32_t cerrif = bit(13);
constexpr std::uint32_t ivmif = bit(15);
constexpr std::uint32_t clearable = 0xF00C;
constexpr std::uint32_t enables = 0xFF1F0000;

// C1TREC
constexpr std::uint32_t ewarn = bit(16);
constexpr std::uint32_t rxwarn = bit(17);
constexpr std::uint32_t txwarn = bit(18);
constexpr std::uint32_t rxbp = bit(19);
constexpr std::uint32_t txbp = bit(20);
constexpr std::uint32_t txbo = bit(21);

// C1BDIAG1
constexpr std::uint32_t txboerr = bit(23);
constexpr std::uint32_t dlcmm = bit(31);

// C1FIFOCON, C1TXQCON, C1TEFCON
constexpr std::uint32_t fifocon_at_reset = 0x00600000;
constexpr std::uint32_t fifo_protected = 0xFF0000A0;  // PLSIZE, FSIZE, TXEN, RXTSEN
constexpr std::uint32_t fifo_writable = 0xFF7F00FF;
constexpr std::uint32_t txq_writable = 0xFF7F0015;
constexpr std::uint32_t tef_protected = 0x1F000020;
constexpr std::uint32_t tef_writable = 0x1F00002F;
constexpr std::uint32_t freset = bit(10);
constexpr std::uint32_t txreq = bit(9);
constexpr std::uint32_t uinc = bit(8);
constexpr std::uint32_t txen = bit(7);
constexpr std::uint32_t rtren = bit(6);
constexpr std::uint32_t tsen = bit(5);

// C1FIFOSTA; the enables of the lower five flags have the same positions in C1FIFOCON
constexpr std::uint32_t txabt = bit(7);
constexpr std::uint32_t txlarb = bit(6);
constexpr std::uint32_t txerr = bit(5);
constexpr std::uint32_t attempts = bit(4);  // TXATIF
constexpr std::uint32_t overflow = bit(3);  // RXOVIF
constexpr std::uint32_t extreme = bit(2);   // empty transmit FIFO, full receive FIFO
constexpr std::uint32_t half = bit(1);
constexpr std::uint32_t basic = bit(0);  // transmit FIFO that is not full, receive FIFO that is not empty

// OSC
constexpr std::uint32_t osc_at_reset = 0x60;
constexpr std::uint32_t osc_protected = 0x11;  // PLLEN, SCLKDIV
constexpr std::uint32_t pllen = bit(0);
constexpr std::uint32_t oscdis = bit(2);
constexpr std::uint32_t lpmen = bit(3);
constexpr std::uint32_t sclkdiv = bit(4);
constexpr std::uint32_t oscrdy = bit(10);

constexpr std::uint32_t iocon_at_reset = 0x03000003;
constexpr std::uint32_t pin_modes = bit(24) | bit(25);  // 1: INT0 and INT1 are inputs or outputs

// Message objects
constexpr std::uint32_t ide = bit(4);
constexpr std::uint32_t rtr = bit(5);
constexpr std::uint32_t brs = bit(6);
constexpr std::uint32_t fdf = bit(7);
constexpr std::uint32_t esi = bit(8);
constexpr std::uint32_t type_bit = bit(30);  // EXIDE, MIDE

// Instructions
constexpr unsigned instruction_reset = 0;
constexpr unsigned instruction_write = 2;
constexpr unsigned instruction_read = 3;
constexpr std::size_t instruction_bytes = 2;

constexpr std::uint32_t undefined = 0xA5A5A5A5;

inline bool is_ram(unsigned address) { return address >= 0x400 && address < 0xC00; }
inline bool is_chip(unsigned address) { return address >= chip_begin && address < chip_end; }
inline bool is_fifo(unsigned address) { return address >= tefcon && address < fltcon && address != first_reserved; }
// Returns 0, 4 or 8: control, status or user address of a FIFO.
inline unsigned part_of(unsigned address) {
  return address >= txqcon ? (address - txqcon) % fifo_bytes : address - tefcon;
}

// Returns the address after a byte; each of the three memories wraps.
inline unsigned following(unsigned address) {
  switch (address) {
    case 0x3FF: return 0;
    case 0xBFF: return 0x400;
    case 0xFFF: return chip_begin;
    default: return address + 1;
  }
}

inline std::uint32_t identifier_word(const CanFrame& frame) {
  return frame.is_extended ? frame.id >> 18 | (frame.id & 0x3FFFF) << 11 : frame.id;
}

}  // namespace mcp251xfd
}  // namespace test
