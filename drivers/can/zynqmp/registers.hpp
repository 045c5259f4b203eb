// SPDX-License-Identifier: Apache-2.0
/// \file registers.hpp
/// The registers of the CAN controllers of Zynq-7000 and Zynq UltraScale+ (UG585, UG1085).
#ifndef CO_DRIVERS_ZYNQMP_REGISTERS_HPP_
#define CO_DRIVERS_ZYNQMP_REGISTERS_HPP_

#include <cstdint>

#include "../controller.hpp"

namespace co::zynqmp {

/// Byte offset of a register. The name in UG585 follows in parentheses.
enum class Register : std::uint8_t {
  software_reset = 0x00,    ///< (SRR)
  mode_select = 0x04,       ///< (MSR)
  prescaler = 0x08,         ///< (BRPR)
  bit_timing = 0x0C,        ///< (BTR)
  error_counters = 0x10,    ///< (ECR)
  status = 0x18,            ///< (SR)
  interrupt_status = 0x1C,  ///< (ISR)
  interrupt_enable = 0x20,  ///< (IER)
  interrupt_clear = 0x24,   ///< (ICR)
  transmit = 0x30,          ///< transmit FIFO: identifier, DLC, two words of data; writing the last one sends the frame
  transmit_first = 0x40,    ///< high priority transmit buffer, with the layout of transmit
  receive = 0x50,           ///< receive FIFO, with the layout of transmit; reading the last register removes the frame
  filters_used = 0x60,      ///< a bit for each acceptance filter (AFR)
  filters = 0x64,           ///< four pairs of mask and identifier (AFMR, AFIR)
};

/// Returns the register \a words words of 4 bytes behind \a first.
constexpr Register operator+(Register first, unsigned words) {
  return static_cast<Register>(static_cast<unsigned>(first) + 4 * words);
}

/// \name Bits of Register::software_reset
/// \{
inline constexpr std::uint32_t soft_reset = 1U << 0;  ///< resets the controller
inline constexpr std::uint32_t can_enable = 1U << 1;  ///< 1: on the bus, 0: configuration mode
/// \}

/// \name Bits of Register::mode_select
/// \{
inline constexpr std::uint32_t sleep_mode = 1U << 0;     ///< sleep until a frame is sent or received
inline constexpr std::uint32_t loopback_mode = 1U << 1;  ///< self-test off the bus
/// \}

inline constexpr unsigned receive_errors_shift = 8;  ///< Register::error_counters: REC behind the 8 bits of TEC

/// \name Bits of Register::status
/// \{
inline constexpr std::uint32_t is_configuring = 1U << 0;  ///< configuration mode
inline constexpr std::uint32_t error_active = 1U << 7;    ///< on the bus: error active, if passive_shift is 0, too
inline constexpr std::uint32_t passive_shift = 8;         ///< position of the bit for error passive
inline constexpr std::uint32_t error_passive = 3U << 7;   ///< on the bus: error passive
inline constexpr std::uint32_t first_is_full = 1U << 10;  ///< the high priority transmit buffer is in use
inline constexpr std::uint32_t filters_busy = 1U << 11;   ///< the acceptance filters must not be written yet
/// \}

/// \name Bits of the interrupt registers
/// An interrupt stays set until it is cleared, and is set again while its cause lasts.
/// \{
inline constexpr std::uint32_t arbitration_lost = 1U << 0;  ///< a frame has lost the arbitration
inline constexpr std::uint32_t sent = 1U << 1;              ///< a frame was sent
inline constexpr std::uint32_t receive_overflow = 1U << 6;  ///< a frame was lost because the receive FIFO was full
inline constexpr std::uint32_t received = 1U << 7;          ///< the receive FIFO is not empty
inline constexpr std::uint32_t bus_off = 1U << 9;           ///< the controller is in bus-off
inline constexpr std::uint32_t woken = 1U << 11;            ///< the sleep mode has ended
inline constexpr std::uint32_t all_sent = 1U << 14;         ///< the transmit FIFO is empty
/// \}

/// \name Layout of the words of a frame
/// Identifier: the bits of the arbitration field in the order of transmission, so that the lower value wins.
/// \{
inline constexpr std::uint32_t standard_shift = 21;         ///< position of the 11 bits of the base identifier
inline constexpr std::uint32_t standard_remote = 1U << 20;  ///< RTR of a frame with 11 bits, SRR of one with 29 bits
inline constexpr std::uint32_t extended = 1U << 19;         ///< IDE: the identifier has 29 bits
inline constexpr std::uint32_t extension_shift = 1;         ///< position of the other 18 bits
inline constexpr std::uint32_t extended_remote = 1U << 0;   ///< RTR of a frame with 29 bits
inline constexpr std::uint32_t dlc_shift = 28;              ///< position of the DLC in its word
/// \}

/// Reads a register of the controller at \a base.
inline std::uint32_t read(const volatile std::uint32_t* base, Register which) {
  return registers::read(base[static_cast<unsigned>(which) / 4]);
}
/// Writes a register of the controller at \a base.
inline void write(volatile std::uint32_t* base, Register which, std::uint32_t value) {
  registers::write(base[static_cast<unsigned>(which) / 4], value);
}

}  // namespace co::zynqmp

#endif
