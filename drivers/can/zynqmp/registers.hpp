// SPDX-License-Identifier: Apache-2.0
/// \file registers.hpp
/// The registers of the CAN controllers of Zynq-7000 and Zynq UltraScale+ (UG585, UG1085), and the only functions that
/// access them, so that a test can replace them by a model.
#ifndef CO_DRIVERS_ZYNQMP_REGISTERS_HPP_
#define CO_DRIVERS_ZYNQMP_REGISTERS_HPP_

#include <cstdint>

namespace co::zynqmp {

enum class Register : std::uint8_t {  // byte offset
  software_reset = 0x00,
  mode_select = 0x04,
  prescaler = 0x08,
  bit_timing = 0x0C,
  status = 0x18,
  interrupt_status = 0x1C,
  interrupt_enable = 0x20,
  interrupt_clear = 0x24,
  transmit = 0x30,        // identifier, DLC, data 1, data 2: writing the last one starts the transmission
  transmit_first = 0x40,  // high priority transmit buffer; same layout
  receive = 0x50,         // same layout; reading the last register removes the frame
  filters_used = 0x60,
  filters = 0x64,  // four pairs of mask and identifier
};

/// Returns the register at a word offset in a group.
constexpr Register operator+(Register first, unsigned words) {
  return static_cast<Register>(static_cast<unsigned>(first) + 4 * words);
}

// Software reset.
inline constexpr std::uint32_t soft_reset = 1U << 0;
inline constexpr std::uint32_t can_enable = 1U << 1;  // 0: configuration mode

// Mode select.
inline constexpr std::uint32_t sleep_mode = 1U << 0;
inline constexpr std::uint32_t loopback_mode = 1U << 1;

// Status.
inline constexpr std::uint32_t is_configuring = 1U << 0;
inline constexpr std::uint32_t error_state = 3U << 7;
inline constexpr std::uint32_t error_active = 1U << 7;
inline constexpr std::uint32_t error_passive = 3U << 7;
inline constexpr std::uint32_t first_is_full = 1U << 10;  // high priority transmit buffer
inline constexpr std::uint32_t filters_busy = 1U << 11;

// Interrupts. They stay set until they are cleared, and are set again while their cause lasts.
inline constexpr std::uint32_t arbitration_lost = 1U << 0;
inline constexpr std::uint32_t sent = 1U << 1;
inline constexpr std::uint32_t receive_overflow = 1U << 6;
inline constexpr std::uint32_t received = 1U << 7;  // the receive FIFO is not empty
inline constexpr std::uint32_t bus_off = 1U << 9;
inline constexpr std::uint32_t woken = 1U << 11;
inline constexpr std::uint32_t all_sent = 1U << 14;  // the transmit FIFO is empty

// Identifier: the bits of the arbitration field in the order of transmission, so that the lower value wins.
inline constexpr std::uint32_t standard_shift = 21;
inline constexpr std::uint32_t standard_remote = 1U << 20;  // SRR in a frame with 29 bits
inline constexpr std::uint32_t extended = 1U << 19;
inline constexpr std::uint32_t extension_shift = 1;
inline constexpr std::uint32_t extended_remote = 1U << 0;

inline constexpr std::uint32_t dlc_shift = 28;

std::uint32_t read(const volatile std::uint32_t* registers, Register which);
void write(volatile std::uint32_t* registers, Register which, std::uint32_t value);

}  // namespace co::zynqmp

#endif
