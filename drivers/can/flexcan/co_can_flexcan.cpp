// SPDX-License-Identifier: Apache-2.0
#include "co_can_flexcan.h"

#include <cstdint>

#include "../controller.hpp"
#include "../transmit.hpp"
#include "flexcan_controller.hpp"
#include "flexcan_filters.hpp"

namespace co::flexcan {
namespace {

using report::State;

constexpr std::int16_t taken = sizeof(CO_IF_FRM);

CO_CAN_FLEXCAN& controller(void* ctx) { return *static_cast<CO_CAN_FLEXCAN*>(ctx); }

// Interrupts
// -----------------------------------------------------------------------------------------------------------

// Interrupts that are always enabled on the bus. Those of transmission are disabled while the loop uses the buffers.
std::uint32_t always_wanted(const CO_CAN_FLEXCAN& can) {
  const Layout layout = layout_of(can);
  return uses_fifo(can) ? CO_FLEXCAN_IFLAG_FRAME | CO_FLEXCAN_IFLAG_OVERFLOW : receive_bits(layout);
}
std::uint32_t of_transmission(const CO_CAN_FLEXCAN& can) { return 7U << layout_of(can).transmit; }
std::uint32_t wanted(const CO_CAN_FLEXCAN& can) { return always_wanted(can) | of_transmission(can); }

// Disables the interrupts. The read-back ensures that the write has reached the controller, so none follows.
void silence(const CO_CAN_FLEXCAN& can) {
  write(can.Registers->Imask1, 0);
  static_cast<void>(read(can.Registers->Imask1));
}

bool is_bus_off(const CO_CAN_FLEXCAN& can) { return (read(can.Registers->Esr1) & CO_FLEXCAN_ESR1_BUS_OFF) != 0; }

// Clears the flag of bus-off. Returns whether it was set.
bool take_bus_off(CO_FLEXCAN_REGISTERS& regs) {
  const bool is_set = (read(regs.Esr1) & CO_FLEXCAN_ESR1_BOFFINT) != 0;
  if (is_set) {
    write(regs.Esr1, CO_FLEXCAN_ESR1_BOFFINT);
  }
  return is_set;
}

// Discards received frames and counters. The interrupts must be disabled.
void discard_received(CO_CAN_FLEXCAN& can) {
  static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
  receive(can);
  static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
  report::restart(can.Report);
}

// On and off the bus --------------------------------------------------------------------------------------------------

const CO_CAN_FLEXCAN_RATE* find_rate(const CO_CAN_FLEXCAN& can, std::uint32_t baud) {
  for (unsigned n = 0; n < can.RateNum; ++n) {
    if (can.Rates[n].Baud == baud) {
      return &can.Rates[n];
    }
  }
  return nullptr;
}

// Goes off the bus after the frame on the wire, to freeze mode. In bus-off only a soft reset leads there: freeze mode
// would corrupt the first frame after bus-off (erratum 9595). It also ends the wait for a frame that does not end
// (erratum 8341). MCR and CTRL2 are set again by configure(), which Init and Enable call.
void go_off_the_bus(CO_CAN_FLEXCAN& can) {
  silence(can);
  can.Rate = nullptr;
  can.IsRecovering = false;
  Mailboxes mailboxes(can);
  mailboxes.abort(transmit::all_mailboxes);
  if (is_bus_off(can) || !request_freeze(can)) {
    soft_reset(*can.Registers);
  }
  transmit::forget(can.Transmit);
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

void go_on_the_bus(CO_CAN_FLEXCAN& can, const CO_CAN_FLEXCAN_RATE& rate) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  go_off_the_bus(can);
  discard_received(can);
  configure(can);
  set_timing(can, rate);
  static_cast<void>(take_bus_off(regs));
  can.Rate = &rate;
  write(regs.Imask1, wanted(can));
  leave_freeze(regs);
}

// Discards all frames and starts the recovery: the controller is on the bus again when it has seen 128 sequences of 11
// recessive bits since bus-off.
void recover(CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  silence(can);
  Mailboxes mailboxes(can);
  transmit::drop(can.Transmit, mailboxes);
  discard_received(can);
  can.IsRecovering = true;
  write(regs.Ctrl1, read(regs.Ctrl1) & ~CO_FLEXCAN_CTRL1_BOFFREC);
  write(regs.Imask1, wanted(can));
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

// Fills an error frame with the changes since the last report. Returns false if there are none.
bool report_events(CO_CAN_FLEXCAN& can, CO_IF_FRM& frame) {
  const State now = state_of(read(can.Registers->Esr1));
  if (can.IsRecovering && now != State::bus_off) {
    end_recovery(can);
  }
  const State state = report::observed(can.Report, now);
  return report::take(can.Report, {state, COCanFlexcanErrors(&can), COCanFlexcanLost(&can)}, frame);
}

// The driver ----------------------------------------------------------------------------------------------------------

void init(void* ctx) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  if ((read(can.Registers->Mcr) & CO_FLEXCAN_MCR_MDIS) == 0) {
    go_off_the_bus(can);
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

void enable(void* ctx, std::uint32_t baud) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  const CO_CAN_FLEXCAN_RATE* const rate = find_rate(can, baud);
  can.Report.Reported = static_cast<std::uint8_t>(State::active);
  if (rate == nullptr) {
    go_off_the_bus(can);
    return;
  }
  if (rate == can.Rate && is_bus_off(can)) {
    recover(can);
    return;
  }
  go_on_the_bus(can, *rate);
}

std::int16_t read_driver(void* ctx, CO_IF_FRM* frm) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  if (can.Rate == nullptr) {
    return 0;
  }
  return report_events(can, *frm) || CORingGet(&can.Received, frm) ? taken : std::int16_t{0};
}

std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  if (can.Rate == nullptr || is_bus_off(can)) {
    return -1;
  }
  Mailboxes mailboxes(can);
  write(can.Registers->Imask1, always_wanted(can));
  const bool accepted = transmit::accept(can.Transmit, mailboxes, *frm);
  write(can.Registers->Imask1, wanted(can));
  return accepted ? taken : std::int16_t{0};
}

void reset(void* ctx) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  if (can.Rate == nullptr) {
    return;
  }
  if (is_bus_off(can)) {
    recover(can);
    return;
  }
  silence(can);
  Mailboxes mailboxes(can);
  transmit::drop(can.Transmit, mailboxes);
  discard_received(can);
  write(can.Registers->Imask1, wanted(can));
}

void close(void* ctx) { go_off_the_bus(controller(ctx)); }

// On the bus, the filters change in freeze mode. Frames that were received before are moved into the queue.
void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
  CO_CAN_FLEXCAN& can = controller(ctx);
  const Filters all = filters_of(ids, num, capacity_of(can));
  const CO_CAN_FLEXCAN_RATE* const rate = can.Rate;
  if (rate == nullptr) {
    write_filters(can, all);
    return;
  }
  silence(can);
  Mailboxes mailboxes(can);
  const unsigned held = is_bus_off(can) ? mailboxes.hold(can.Transmit) : 0;
  if (!request_freeze(can)) {
    go_off_the_bus(can);
    configure(can);
    write_filters(can, all);
    go_on_the_bus(can, *rate);
    return;
  }
  receive(can);
  write_filters(can, all);
  mailboxes.resume(can.Transmit, held);
  write(can.Registers->Imask1, wanted(can));
  leave_freeze(*can.Registers);
}

}  // namespace
}  // namespace co::flexcan

using namespace co;
using namespace co::flexcan;

const CO_IF_CAN_DRV_EX FlexcanCanDriver = {init, enable, read_driver, send, reset, close, filter, CONodeCanReport};

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

bool COCanFlexcanHasFrames(const CO_CAN_FLEXCAN* can) { return can != nullptr && CORingCount(&can->Received) != 0; }

uint32_t COCanFlexcanLost(const CO_CAN_FLEXCAN* can) {
  return can == nullptr ? 0 : report::load(can->Report.Overflows) + CORingLost(&can->Received);
}

CO_CAN_ERROR_COUNTERS COCanFlexcanErrors(const CO_CAN_FLEXCAN* can) {
  if (can == nullptr) {
    return {};
  }
  const std::uint32_t errors = read(can->Registers->Ecr);
  return {CO_FLEXCAN_ECR_TEC(errors), CO_FLEXCAN_ECR_REC(errors)};
}

}  // extern "C"
