// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_controller.hpp
/// Operations on a FlexCAN controller, for its driver.
#ifndef CO_DRIVERS_FLEXCAN_CONTROLLER_HPP_
#define CO_DRIVERS_FLEXCAN_CONTROLLER_HPP_

#include <cstdint>

#include "../controller.hpp"
#include "../transmit.hpp"
#include "co_can_flexcan.h"
#include "flexcan_filters.hpp"

namespace co::flexcan {
/// \cond internal

using registers::read;
using registers::write;

/// Use of the message buffers. Those of the FIFO come first. The first other one is reserved (erratum 5829); those that
/// receive follow, then three for transmission.
struct Layout {
  unsigned steps;     ///< CTRL2.RFFN
  unsigned reserved;  ///< inactive
  unsigned receive;   ///< first one; with the FIFO there are none
  unsigned transmit;  ///< first of three; the end of those that receive
};

inline bool uses_fifo(const CO_CAN_FLEXCAN& can) { return can.Receive == CO_CAN_FLEXCAN_FIFO; }

Layout layout_of(const CO_CAN_FLEXCAN& can);

/// Returns the interrupt bits of the message buffers that receive.
inline std::uint32_t receive_bits(const Layout& layout) {
  return static_cast<std::uint32_t>((std::uint64_t{1} << layout.transmit) - (std::uint64_t{1} << layout.receive));
}

/// \name Module
/// \{

/// Enables the module and resets it: it is in freeze mode then.
void start_module(const CO_CAN_FLEXCAN& can);
/// Resets the module, to freeze mode. Message buffers and masks are kept.
void soft_reset(CO_FLEXCAN_REGISTERS& regs);
/// Enters freeze mode after the frame on the wire. Returns false if the controller does not in time.
bool request_freeze(const CO_CAN_FLEXCAN& can);
void leave_freeze(CO_FLEXCAN_REGISTERS& regs);

/// \}
/// \name In freeze mode
/// \{

/// Writes zero to the memory, so that its ECC is valid.
void prepare_memory(const CO_CAN_FLEXCAN& can);
/// Sets the mode of operation, and the message buffers to their use.
void configure(const CO_CAN_FLEXCAN& can);
/// Returns a filter that passes all frames.
Filters everything();
Capacity capacity_of(const CO_CAN_FLEXCAN& can);
void write_filters(CO_CAN_FLEXCAN& can, const Filters& all);

/// \}

/// Moves all received frames into the queue.
void receive(CO_CAN_FLEXCAN& can);

/// Transmit buffers of a controller, for transmit.hpp.
class Mailboxes {
 public:
  explicit Mailboxes(const CO_CAN_FLEXCAN& can)
      : regs_(*can.Registers), layout_(layout_of(can)), is_loopback_(can.Loopback) {}

  transmit::Completed take_completed(unsigned used);
  static unsigned free_mailbox(unsigned used, const CO_IF_FRM& frame);
  void request(unsigned n, const CO_IF_FRM& frame);
  void abort(unsigned mailboxes);
  bool is_delayed(unsigned n);

  /// Takes the pending requests back, for freeze mode in bus-off (erratum 9595). Returns those that resume() renews.
  unsigned hold(const CO_CAN_TRANSMIT& box);
  void resume(const CO_CAN_TRANSMIT& box, unsigned held);

 private:
  CO_FLEXCAN_MAILBOX& mailbox(unsigned n) { return regs_.Mailbox[layout_.transmit + n]; }
  std::uint32_t flag(unsigned n) const { return std::uint32_t{1} << (layout_.transmit + n); }
  std::uint32_t code(unsigned n) { return read(mailbox(n).Control) & CO_FLEXCAN_CODE; }
  void wait_for_start();

  CO_FLEXCAN_REGISTERS& regs_;
  Layout layout_;
  bool is_loopback_;
};

/// \endcond
}  // namespace co::flexcan

#endif
