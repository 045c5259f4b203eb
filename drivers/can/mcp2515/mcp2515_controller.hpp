// SPDX-License-Identifier: Apache-2.0
/// \file mcp2515_controller.hpp
/// Operations on a controller, for its driver.
#ifndef CO_DRIVERS_MCP2515_CONTROLLER_HPP_
#define CO_DRIVERS_MCP2515_CONTROLLER_HPP_

#include <cstdint>

#include "../spi.hpp"
#include "co_can_mcp2515.h"
#include "mcp2515_filters.hpp"

namespace co::mcp2515 {
/// \cond internal

using Can = CO_CAN_MCP2515;
using spi::Exclusive;
using spi::has_interrupt;
using spi::transact;

/// Readings until a wait ends without success. The frame on the wire has to end before the controller goes off the bus.
inline constexpr unsigned status_reads = 20000;
inline constexpr std::uint8_t no_answer = 0xFF;  ///< of a controller that is not connected
inline constexpr std::uint8_t overflows = CO_MCP2515_EFLG_RX0OVR | CO_MCP2515_EFLG_RX1OVR;
inline constexpr std::uint8_t receive_interrupts = CO_MCP2515_INT_RX(0) | CO_MCP2515_INT_RX(1);
inline constexpr std::uint8_t transmit_interrupts = CO_MCP2515_INT_TX(0) | CO_MCP2515_INT_TX(1) | CO_MCP2515_INT_TX(2);
inline constexpr std::uint8_t all_interrupts = receive_interrupts | transmit_interrupts | CO_MCP2515_INT_ERR;

/// \name SPI instructions
/// \{

/// Sends bytes of a word, the lowest one first. Returns the bytes that were received instead of them.
std::uint32_t instruct(const Can& can, std::uint32_t word, unsigned number);

inline unsigned read(const Can& can, unsigned address) {
  return instruct(can, CO_MCP2515_READ | address << 8, 3) >> 16;
}
/// Returns a register and, in bits 8…15, the next one.
inline unsigned read_two(const Can& can, unsigned address) {
  return instruct(can, CO_MCP2515_READ | address << 8, 4) >> 16;
}
inline unsigned read_status(const Can& can) { return instruct(can, CO_MCP2515_READ_STATUS, 2) >> 8; }
inline void write(const Can& can, unsigned address, unsigned value) {
  static_cast<void>(instruct(can, CO_MCP2515_WRITE | address << 8 | value << 16, 3));
}
inline void clear_bits(const Can& can, unsigned address, unsigned bits) {
  static_cast<void>(instruct(can, CO_MCP2515_BIT_MODIFY | address << 8 | bits << 16, 4));
}
void write_control(const Can& can, unsigned bits);
void enable_interrupts(Can& can, unsigned bits);
/// Codes a word of mcp2515_filters.hpp for SIDH, SIDL, EID8 and EID0.
void put_word(std::uint32_t word, std::uint8_t* bytes);

/// \}
/// \name Modes
/// \{

inline unsigned mode_on_bus(const Can& can) { return can.Loopback ? CO_MCP2515_MODE_LOOPBACK : CO_MCP2515_MODE_NORMAL; }

/// Resets the controller, to Configuration mode.
void reset_controller(const Can& can);
/// Goes off the bus after the frame on the wire. A controller that does not follow is reset. Frames that were not sent
/// are displaced.
void enter_configuration(Can& can);
/// Writes all registers that determine the function of the controller, which is in Configuration mode. Returns false if
/// it does not answer.
bool write_configuration(Can& can, const CO_CAN_MCP2515_RATE& rate);

/// \}
/// \name Frames
/// \{

/// Stores the results of transmissions, and requests the frames that wait.
void request_waiting(Can& can);
/// Accepts a frame for transmission, or refuses it (false).
bool accept(Can& can, const CO_IF_FRM& frame);
/// Starts to discard all frames. A frame that is on the wire is completed.
void begin_drop(Can& can);
/// Aborts the frames that are not on the wire and waits for the end of that on the wire. Results are stored.
void await_idle_buffers(Can& can);
/// Moves the received frames into the queue.
void receive(Can& can, unsigned flags);

/// \}
/// \name Interrupts
/// \{

/// Does the work of the interrupt, until INT is high. What is left after some rounds is done by Read.
void service(Can& can);

inline bool is_in_bus_off(const Can& can) { return can.IsBusOff != 0 || (can.Flags & CO_MCP2515_EFLG_TXBO) != 0; }

/// \}

/// \endcond
}  // namespace co::mcp2515

#endif
