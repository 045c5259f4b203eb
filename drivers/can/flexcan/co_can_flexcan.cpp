// SPDX-License-Identifier: Apache-2.0
#include "co_can_flexcan.h"

#include <cstdint>

#include "../controller.hpp"
#include "flexcan_controller.hpp"
#include "flexcan_filters.hpp"

namespace co::flexcan {
namespace {

using report::State;

// Interrupts that are always enabled on the bus. Those of transmission are disabled while the loop uses the buffers.
std::uint32_t always_wanted(const CO_CAN_FLEXCAN& can) {
  const Layout layout = layout_of(can);
  return uses_fifo(can) ? CO_FLEXCAN_IFLAG_FRAME | CO_FLEXCAN_IFLAG_OVERFLOW : receive_bits(layout);
}
std::uint32_t of_transmission(const CO_CAN_FLEXCAN& can) { return 7U << layout_of(can).transmit; }
std::uint32_t wanted(const CO_CAN_FLEXCAN& can) { return always_wanted(can) | of_transmission(can); }

// Clears the flag of bus-off. Returns whether it was set.
bool take_bus_off(CO_FLEXCAN_REGISTERS& regs) {
  const bool is_set = (read(regs.Esr1) & CO_FLEXCAN_ESR1_BOFFINT) != 0;
  if (is_set) {
    write(regs.Esr1, CO_FLEXCAN_ESR1_BOFFINT);
  }
  return is_set;
}

// Writes the bit timing: to CBT only if the table has a rate for it, as other controllers do not have this register.
void set_timing(const CO_CAN_FLEXCAN& can, const CO_CAN_FLEXCAN_RATE& rate) {
  const bool recovers = can.Recovery == CO_CAN_RECOVERY_AUTOMATIC;
  std::uint32_t wide = 0;
  for (unsigned n = 0; n < can.RateNum; ++n) {
    wide |= can.Rates[n].Wide;
  }
  write(can.Registers->Ctrl1, rate.Timing | CO_FLEXCAN_CTRL1_BOFFMSK | (can.BusClock ? CO_FLEXCAN_CTRL1_CLKSRC : 0) |
                                  (can.Loopback ? CO_FLEXCAN_CTRL1_LPB : 0) |
                                  (recovers ? 0 : CO_FLEXCAN_CTRL1_BOFFREC));
  if (wide != 0) {
    write(can.Registers->Cbt, rate.Wide);
  }
}

// Disables the recovery from the next bus-off, after the present one has ended.
void end_recovery(CO_CAN_FLEXCAN& can) {
  can.IsRecovering = false;
  if (can.Recovery != CO_CAN_RECOVERY_AUTOMATIC) {
    write(can.Registers->Ctrl1, read(can.Registers->Ctrl1) | CO_FLEXCAN_CTRL1_BOFFREC);
  }
}

State state_of(std::uint32_t status) {
  if ((status & CO_FLEXCAN_ESR1_BUS_OFF) != 0) {
    return State::bus_off;
  }
  return (status & CO_FLEXCAN_ESR1_PASSIVE) != 0 ? State::passive : State::active;
}

struct Port : controller::MailboxPort<Port, CO_CAN_FLEXCAN> {
  using Can = CO_CAN_FLEXCAN;
  using Mailboxes = flexcan::Mailboxes;

  // The read-back ensures that the write has reached the controller, so no interrupt follows.
  static void disable_interrupts(const Can& can) {
    write(can.Registers->Imask1, 0);
    static_cast<void>(read(can.Registers->Imask1));
  }
  static void enable_receive_interrupts(const Can& can) { write(can.Registers->Imask1, always_wanted(can)); }
  static void enable_interrupts(const Can& can) { write(can.Registers->Imask1, wanted(can)); }

  static bool is_bus_off(const Can& can) { return (read(can.Registers->Esr1) & CO_FLEXCAN_ESR1_BUS_OFF) != 0; }

  static State poll(Can& can) {
    const State state = state_of(read(can.Registers->Esr1));
    if (can.IsRecovering && state != State::bus_off) {
      end_recovery(can);
    }
    return state;
  }

  static CO_CAN_ERROR_COUNTERS errors(const Can& can) {
    const std::uint32_t errors = read(can.Registers->Ecr);
    return {CO_FLEXCAN_ECR_TEC(errors), CO_FLEXCAN_ECR_REC(errors)};
  }

  static void receive(Can& can) { flexcan::receive(can); }

  // Enters freeze mode. In bus-off only a soft reset leads there: freeze mode would corrupt the first frame after
  // bus-off (erratum 9595). It also ends the wait for a frame that does not end (erratum 8341). MCR and CTRL2 are set
  // again by configure(), which Init and Enable call.
  static void leave_bus(Can& can) {
    disable_interrupts(can);
    can.Rate = nullptr;
    can.IsRecovering = false;
    Mailboxes mailboxes(can);
    mailboxes.abort(transmit::all_mailboxes);
    if (is_bus_off(can) || !request_freeze(can)) {
      soft_reset(*can.Registers);
    }
    transmit::forget(can.Transmit);
  }

  // In bus-off with the same bit rate, discards all frames and starts the recovery: the controller is on the bus again
  // when it has seen 128 sequences of 11 recessive bits since bus-off.
  static void join_bus(Can& can, const CO_CAN_FLEXCAN_RATE& rate) {
    CO_FLEXCAN_REGISTERS& regs = *can.Registers;
    if (&rate == can.Rate && is_bus_off(can)) {
      discard(can);
      can.IsRecovering = true;
      write(regs.Ctrl1, read(regs.Ctrl1) & ~CO_FLEXCAN_CTRL1_BOFFREC);
      return;
    }
    leave_bus(can);
    discard_received(can);
    configure(can);
    set_timing(can, rate);
    static_cast<void>(take_bus_off(regs));
    can.Rate = &rate;
    enable_interrupts(can);
    leave_freeze(regs);
  }

  static void init(Can& can) {
    if ((read(can.Registers->Mcr) & CO_FLEXCAN_MCR_MDIS) == 0) {
      leave_bus(can);
    }
    can.Rate = nullptr;
    can.IsRecovering = false;
    transmit::forget(can.Transmit);
    start_module(can);
    prepare_memory(can);
    can.RejectsAll = false;
    configure(can);
    write_filters(can, everything());
    discard_received(can);
  }

  // On the bus, the filters change in freeze mode. Frames that were received before are moved into the queue.
  static void filter(Can& can, const std::uint32_t* ids, unsigned num) {
    const Filters all = filters_of(ids, num, capacity_of(can));
    const CO_CAN_FLEXCAN_RATE* const rate = can.Rate;
    if (rate == nullptr) {
      write_filters(can, all);
      return;
    }
    disable_interrupts(can);
    Mailboxes mailboxes(can);
    const unsigned held = is_bus_off(can) ? mailboxes.hold(can.Transmit) : 0;
    if (!request_freeze(can)) {
      leave_bus(can);
      configure(can);
      write_filters(can, all);
      join_bus(can, *rate);
      return;
    }
    receive(can);
    write_filters(can, all);
    mailboxes.resume(can.Transmit, held);
    enable_interrupts(can);
    leave_freeze(*can.Registers);
  }
};

using Driver = controller::Driver<Port>;

}  // namespace
}  // namespace co::flexcan

using namespace co;
using namespace co::flexcan;

const CO_IF_CAN_DRV_EX FlexcanCanDriver = flexcan::Driver::table;

extern "C" {

void COCanFlexcanInterrupt(CO_CAN_FLEXCAN* can) {
  ASSERT_PTR(can);
  if (can->Rate == nullptr) {
    return;
  }
  CO_FLEXCAN_REGISTERS& regs = *can->Registers;
  receive(*can);
  if (take_bus_off(regs)) {
    report::count_bus_off(can->Report);
  }
  if ((read(regs.Imask1) & of_transmission(*can)) != 0) {
    Mailboxes mailboxes(*can);
    transmit::finish(can->Transmit, mailboxes);
  }
}

bool COCanFlexcanHasFrames(const CO_CAN_FLEXCAN* can) { return flexcan::Driver::has_frames(can); }
uint32_t COCanFlexcanLost(const CO_CAN_FLEXCAN* can) { return flexcan::Driver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanFlexcanErrors(const CO_CAN_FLEXCAN* can) { return flexcan::Driver::errors(can); }

}  // extern "C"
