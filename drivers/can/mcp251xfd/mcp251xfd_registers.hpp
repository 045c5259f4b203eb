// SPDX-License-Identifier: Apache-2.0
/// \file mcp251xfd_registers.hpp
/// SPI instructions, registers and message objects of the CAN controllers MCP2517FD and MCP2518FD, as far as they are
/// used.
///
/// Source: [MCP25xxFD] "MCP25XXFD Family Reference Manual", Microchip, DS20005678.
#ifndef CO_DRIVERS_MCP251XFD_REGISTERS_HPP_
#define CO_DRIVERS_MCP251XFD_REGISTERS_HPP_

#include <cstdint>

namespace co::mcp251xfd {
/// \cond internal

/// \name Instructions, combined with an address; RESET is 0
/// \{
inline constexpr unsigned instruction_write = 0x2000;
inline constexpr unsigned instruction_read = 0x3000;
/// \}

/// \name Addresses
/// \{
inline constexpr unsigned control = 0x000;  ///< C1CON
inline constexpr unsigned timing = 0x004;   ///< C1NBTCFG, followed by C1DBTCFG
inline constexpr unsigned data_timing = 0x008;
inline constexpr unsigned interrupts = 0x01C;       ///< C1INT: flags, in the upper half enables
inline constexpr unsigned errors = 0x034;           ///< C1TREC
inline constexpr unsigned diagnosis = 0x03C;        ///< C1BDIAG1
inline constexpr unsigned event_control = 0x040;    ///< C1TEFCON
inline constexpr unsigned event_status = 0x044;     ///< C1TEFSTA, followed by C1TEFUA
inline constexpr unsigned queue_control = 0x050;    ///< C1TXQCON, followed by C1TXQSTA, C1TXQUA
inline constexpr unsigned receive_control = 0x05C;  ///< C1FIFOCON1
inline constexpr unsigned receive_status = 0x060;   ///< C1FIFOSTA1, followed by C1FIFOUA1
inline constexpr unsigned filter_control = 0x1D0;   ///< C1FLTCON: a byte for each filter
inline constexpr unsigned filter_object = 0x1F0;    ///< C1FLTOBJ, C1MASK: two words for each filter
inline constexpr unsigned message_memory = 0x400;   ///< address of the object to which a register UA of 0 points
inline constexpr unsigned message_memory_end = 0xC00;
inline constexpr unsigned oscillator = 0xE00;  ///< OSC
/// \}

/// \name C1CON; byte 3 has the requested mode
/// \{
inline constexpr std::uint32_t control_mode = std::uint32_t{7} << 21;  ///< OPMOD
inline constexpr std::uint32_t control_configuration = std::uint32_t{4} << 21;
inline constexpr unsigned request_normal = 0;  ///< REQOP: CAN FD and classic frames
inline constexpr unsigned request_loopback = 2;
inline constexpr unsigned request_configuration = 4;
inline constexpr unsigned request_abort = 8;  ///< ABAT: aborts all messages that are not on the wire
/// \}

/// \name C1INT
/// \{
inline constexpr std::uint32_t interrupt_receive = 1U << 1;
inline constexpr std::uint32_t interrupt_mode = 1U << 3;  ///< MODIF: the mode has changed
inline constexpr std::uint32_t interrupt_event = 1U << 4;
inline constexpr std::uint32_t interrupt_error = 1U << 13;  ///< CERRIF: the error state has changed
/// \}

/// \name C1TREC, shifted by 16 bits; the counters are in the lower half
/// \{
inline constexpr unsigned error_passive = 0x18;  ///< RXBP, TXBP
inline constexpr unsigned error_bus_off = 0x20;  ///< TXBO
/// \}

inline constexpr std::uint32_t diagnosis_bus_off = 1U << 23;  ///< C1BDIAG1.TXBOERR

/// \name C1TEFCON, C1TXQCON, C1FIFOCON1, and the same bits shifted for their byte 1
/// \{
constexpr std::uint32_t objects(unsigned number) { return (number - 1U) << 24; }  ///< FSIZE; PLSIZE 0: 8 bytes
inline constexpr std::uint32_t not_empty_enable = 1U << 0;                        ///< TFNRFNIE, TEFNEIE
inline constexpr std::uint32_t requested = 1U << 9;                               ///< TXREQ
inline constexpr std::uint32_t resetting = 1U << 10;                              ///< FRESET; set in Configuration mode
inline constexpr unsigned byte_next = 1;                                          ///< UINC
inline constexpr unsigned byte_request = 2;                                       ///< TXREQ
inline constexpr unsigned byte_reset = 4;                                         ///< FRESET
/// \}

/// \name C1TEFSTA, C1TXQSTA, C1FIFOSTA1
/// \{
inline constexpr std::uint32_t status_ready = 1U << 0;             ///< a received message or an event; TXQ: not full
inline constexpr std::uint32_t status_overflow = 1U << 3;          ///< RXOVIF
inline constexpr std::uint32_t status_lost_arbitration = 1U << 6;  ///< TXLARB
/// \}

/// \name C1FLTCON, C1FLTOBJ, C1MASK and the first two words of a message
/// \{
inline constexpr unsigned filter_to_fifo1 = 0x81;                         ///< FLTEN, FnBP
inline constexpr std::uint32_t filter_extended = std::uint32_t{1} << 30;  ///< EXIDE, MIDE
inline constexpr std::uint32_t message_dlc = 0x0F;
inline constexpr std::uint32_t message_extended = 0x10;
inline constexpr std::uint32_t message_remote = 0x20;
inline constexpr std::uint32_t message_fd = 0x80;
inline constexpr unsigned message_sequence = 9;  ///< position of SEQ: 7 bits
/// \}

/// \name OSC
/// \{
inline constexpr std::uint32_t oscillator_pll = 1U << 0;  ///< PLLEN
inline constexpr unsigned pll_to_ready = 8;               ///< from PLLEN to PLLRDY
inline constexpr std::uint32_t oscillator_ready = 1U << 10;
/// \}

/// \endcond
}  // namespace co::mcp251xfd

#endif
