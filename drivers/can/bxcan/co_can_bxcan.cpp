// SPDX-License-Identifier: Apache-2.0
#include "co_can_bxcan.h"

#include <cstdint>

#include "../controller.hpp"
#include "../transmit.hpp"
#include "bxcan_filters.hpp"

namespace co::bxcan {
namespace {

using report::State;

// Interrupts that are always enabled on the bus. TMEIE is disabled while the loop uses the mailboxes.
constexpr std::uint32_t always_enabled =
    CO_BXCAN_IER_FMPIE0 | CO_BXCAN_IER_FOVIE0 | CO_BXCAN_IER_EPVIE | CO_BXCAN_IER_BOFIE | CO_BXCAN_IER_ERRIE;
constexpr std::uint32_t enabled_on_bus = always_enabled | CO_BXCAN_IER_TMEIE;

// Limits of loops. The frame on the bus has to end before the initialisation mode is entered; about 3 ms at 72 MHz.
constexpr unsigned status_reads = 20000;
constexpr unsigned fifo_reads = 32;

using registers::read;
using registers::write;

// Transmitting --------------------------------------------------------------------------------------------------------

// Mailboxes of a controller, for transmit.hpp.
class Mailboxes {
 public:
  explicit Mailboxes(CO_CAN_BXCAN& can) : regs_(*can.Registers), is_loopback_(can.Loopback) {}

  // An abort request for a mailbox that is empty already clears RQCP and TXOK of some devices: its frame was sent.
  transmit::Completed take_completed(unsigned used) {
    const std::uint32_t status = read(regs_.Tsr);
    transmit::Completed completed = {};
    std::uint32_t acknowledged = 0;
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if ((status & CO_BXCAN_TSR_RQCP(n)) != 0) {
        acknowledged |= CO_BXCAN_TSR_RQCP(n);
        completed.done |= 1U << n;
        completed.sent |= (status & CO_BXCAN_TSR_TXOK(n)) != 0 ? 1U << n : 0;
      } else if ((used & (1U << n)) != 0 && (status & CO_BXCAN_TSR_TME(n)) != 0) {
        completed.done |= 1U << n;
        completed.sent |= 1U << n;
      }
    }
    if (acknowledged != 0) {
      write(regs_.Tsr, acknowledged);
    }
    return completed;
  }

  unsigned free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) {
    const std::uint32_t status = read(regs_.Tsr);
    unsigned n = 0;
    while (n < CO_CAN_MAILBOXES && ((used & (1U << n)) != 0 || (status & CO_BXCAN_TSR_TME(n)) == 0)) {
      ++n;
    }
    return n;
  }

  void request(unsigned n, const CO_IF_FRM& frame) {
    CO_BXCAN_MAILBOX& mailbox = regs_.Transmit[n];
    write(mailbox.Length, transmit::length_of(frame));
    write(mailbox.DataLow, transmit::word_at(frame.Data));
    write(mailbox.DataHigh, transmit::word_at(frame.Data + 4));
    write(mailbox.Identifier, identifier_word(frame.Identifier) | CO_BXCAN_IR_TXRQ);
  }

  void abort(unsigned mailboxes) {
    std::uint32_t requests = 0;
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      requests |= (mailboxes & (1U << n)) != 0 ? CO_BXCAN_TSR_ABRQ(n) : 0;
    }
    write(regs_.Tsr, requests);
  }

  bool is_delayed(unsigned n) {
    const bool has_lost = (read(regs_.Tsr) & CO_BXCAN_TSR_ALST(n)) != 0;
    return !is_loopback_ && (has_lost || (read(regs_.Msr) & CO_BXCAN_MSR_RXM) != 0);
  }

 private:
  static std::uint32_t identifier_word(std::uint32_t identifier) {
    const std::uint32_t id = identifier & CO_IF_FRM_ID;
    const std::uint32_t remote = (identifier & CO_IF_FRM_RTR) != 0 ? CO_BXCAN_IR_RTR : 0;
    return transmit::is_extended(identifier) ? (id << CO_BXCAN_IR_EXID_SHIFT) | CO_BXCAN_IR_IDE | remote
                                             : (id << CO_BXCAN_IR_STID_SHIFT) | remote;
  }

  CO_BXCAN_REGISTERS& regs_;
  bool is_loopback_;
};

// Receiving -----------------------------------------------------------------------------------------------------------

std::uint32_t identifier_of(std::uint32_t word) {
  const std::uint32_t remote = (word & CO_BXCAN_IR_RTR) != 0 ? CO_IF_FRM_RTR : 0;
  return (word & CO_BXCAN_IR_IDE) != 0 ? (word >> CO_BXCAN_IR_EXID_SHIFT) | CO_IF_FRM_EXT | remote
                                       : (word >> CO_BXCAN_IR_STID_SHIFT) | remote;
}

CO_IF_FRM read_frame(const CO_BXCAN_MAILBOX& mailbox) {
  CO_IF_FRM frame{};
  frame.Identifier = identifier_of(read(mailbox.Identifier));
  frame.DLC = transmit::length_of(read(mailbox.Length) & CO_BXCAN_DTR_DLC);
  transmit::unpack(read(mailbox.DataLow), frame.Data);
  transmit::unpack(read(mailbox.DataHigh), frame.Data + 4);
  return frame;
}

// Filters -------------------------------------------------------------------------------------------------------------

CO_BXCAN_REGISTERS& filter_registers(const CO_CAN_BXCAN& can) {
  return can.Master != nullptr ? *can.Master : *can.Registers;
}

std::uint32_t bank_bit(unsigned bank) { return std::uint32_t{1} << bank; }

// Returns the bank that passes all frames: while filters are changed, or if the node has not set any.
unsigned open_bank(const CO_CAN_BXCAN& can) { return can.FirstBank + can.BankNum - 1U; }

std::uint32_t own_banks(const CO_CAN_BXCAN& can) {
  const std::uint32_t up_to_last = (bank_bit(open_bank(can)) << 1) - 1;  // bank 31 does not exist
  return up_to_last & ~(bank_bit(can.FirstBank) - 1);
}

// Returns the value of FMR: the first bank of CAN2 follows from the banks of the controllers.
std::uint32_t master_word(const CO_CAN_BXCAN& can, std::uint32_t present) {
  constexpr std::uint8_t banks_of_one = 14;
  if (can.Master == nullptr && can.BankNum <= banks_of_one) {
    return present & ~CO_BXCAN_FMR_FINIT;
  }
  const std::uint32_t first = can.Master != nullptr ? can.FirstBank : can.BankNum;
  return (present & ~(CO_BXCAN_FMR_FINIT | CO_BXCAN_FMR_CAN2SB)) | (first << CO_BXCAN_FMR_CAN2SB_SHIFT);
}

// Selects two filters of 16 bits with masks in each bank of the controller, and FIFO 0. Reception of both controllers
// stops for the change; if nothing changes, as after a reset of the CPU, it does not stop.
void select_filter_mode(const CO_CAN_BXCAN& can) {
  CO_BXCAN_REGISTERS& regs = filter_registers(can);
  const std::uint32_t own = own_banks(can);
  const std::uint32_t master = read(regs.Fmr);
  const std::uint32_t next = master_word(can, master);
  const std::uint32_t mode = read(regs.Fm1r);
  const std::uint32_t scale = read(regs.Fs1r);
  const std::uint32_t fifo = read(regs.Ffa1r);
  if (((mode | scale | fifo) & own) == 0 && next == master) {
    return;
  }
  write(regs.Fmr, master | CO_BXCAN_FMR_FINIT);
  write(regs.Fm1r, mode & ~own);
  write(regs.Fs1r, scale & ~own);
  write(regs.Ffa1r, fifo & ~own);
  write(regs.Fmr, next | CO_BXCAN_FMR_FINIT);
  write(regs.Fmr, next);
}

void open_filters(const CO_CAN_BXCAN& can) {
  CO_BXCAN_REGISTERS& regs = filter_registers(can);
  const std::uint32_t others = read(regs.Fa1r) & ~own_banks(can);
  write(regs.Fa1r, others);
  select_filter_mode(can);
  write(regs.Bank[open_bank(can)].First, 0);
  write(regs.Bank[open_bank(can)].Second, 0);
  write(regs.Fa1r, others | bank_bit(open_bank(can)));
}

std::uint32_t filter_word(const Filter& filter) { return filter.word | (std::uint32_t{filter.mask} << 16); }

// Replaces the filters. All frames pass meanwhile, so that none is lost.
void set_filters(const CO_CAN_BXCAN& can, const Filters& all) {
  CO_BXCAN_REGISTERS& regs = filter_registers(can);
  const std::uint32_t others = read(regs.Fa1r) & ~own_banks(can);
  const std::uint32_t open = bank_bit(open_bank(can));
  std::uint32_t active = 0;
  write(regs.Fa1r, read(regs.Fa1r) | open);
  write(regs.Fa1r, others | open);
  for (unsigned n = 0; n < all.number; n += 2) {
    const unsigned bank = can.FirstBank + n / 2;
    const Filter& second = all.filter[n + 1 < all.number ? n + 1 : n];
    write(regs.Bank[bank].First, filter_word(all.filter[n]));
    write(regs.Bank[bank].Second, filter_word(second));
    active |= bank_bit(bank);
  }
  write(regs.Fa1r, others | open | active);
  write(regs.Fa1r, others | active);
}

// Joining and leaving the bus -----------------------------------------------------------------------------------------

// Enters the initialisation mode. Returns false if the controller does not.
bool request_initialisation(CO_BXCAN_REGISTERS& regs) {
  write(regs.Mcr, CO_BXCAN_MCR_INRQ | CO_BXCAN_MCR_FREEZE);
  unsigned left = status_reads;
  while (left != 0 && (read(regs.Msr) & CO_BXCAN_MSR_INAK) == 0) {
    --left;
  }
  return left != 0;
}

State state_of(std::uint32_t status) {
  if ((status & CO_BXCAN_ESR_BOFF) != 0) {
    return State::bus_off;
  }
  return (status & CO_BXCAN_ESR_EPVF) != 0 ? State::passive : State::active;
}

struct Port : controller::MailboxPort<Port, CO_CAN_BXCAN> {
  using Can = CO_CAN_BXCAN;
  using Mailboxes = bxcan::Mailboxes;

  // The read-back ensures that the write has reached the controller, so no interrupt follows.
  static void disable_interrupts(const Can& can) {
    write(can.Registers->Ier, 0);
    static_cast<void>(read(can.Registers->Ier));
  }
  static void enable_receive_interrupts(const Can& can) { write(can.Registers->Ier, always_enabled); }
  static void enable_interrupts(const Can& can) { write(can.Registers->Ier, enabled_on_bus); }

  static bool is_bus_off(const Can& can) { return (read(can.Registers->Esr) & CO_BXCAN_ESR_BOFF) != 0; }
  static State poll(const Can& can) { return state_of(read(can.Registers->Esr)); }
  static CO_CAN_ERROR_COUNTERS errors(const Can& can) {
    const std::uint32_t status = read(can.Registers->Esr);
    return {CO_BXCAN_ESR_TEC(status), CO_BXCAN_ESR_REC(status)};
  }

  // Empties FIFO 0. The controller takes a few clock periods to release a frame.
  static void receive(Can& can) {
    CO_BXCAN_REGISTERS& regs = *can.Registers;
    for (unsigned n = 0; n < fifo_reads; ++n) {
      const std::uint32_t status = read(regs.Rf0r);
      if ((status & CO_BXCAN_RFR_FOVR) != 0) {
        write(regs.Rf0r, CO_BXCAN_RFR_FOVR);
        report::count_overflow(can.Report);
      }
      if ((status & CO_BXCAN_RFR_RFOM) != 0) {
        continue;
      }
      if ((status & CO_BXCAN_RFR_FMP) == 0) {
        return;
      }
      const CO_IF_FRM frame = read_frame(regs.Receive[0]);
      write(regs.Rf0r, CO_BXCAN_RFR_RFOM);
      static_cast<void>(CORingPut(&can.Received, &frame));
    }
  }

  // Refuses frames while the controller waits for 11 recessive bits.
  static bool accept(Can& can, const CO_IF_FRM& frame) {
    return (read(can.Registers->Msr) & CO_BXCAN_MSR_INAK) == 0 && MailboxPort::accept(can, frame);
  }

  // A reset of the controller takes it off a bus whose frame does not end in time.
  static void leave_bus(Can& can) {
    CO_BXCAN_REGISTERS& regs = *can.Registers;
    disable_interrupts(can);
    can.Rate = nullptr;
    Mailboxes mailboxes(can);
    mailboxes.abort(transmit::all_mailboxes);
    if (!request_initialisation(regs)) {
      write(regs.Mcr, CO_BXCAN_MCR_RESET);
      static_cast<void>(request_initialisation(regs));
    }
    static_cast<void>(mailboxes.take_completed(transmit::all_mailboxes));
    transmit::forget(can.Transmit);
  }

  static void join_bus(Can& can, const CO_CAN_BXCAN_RATE& rate) {
    CO_BXCAN_REGISTERS& regs = *can.Registers;
    leave_bus(can);
    discard_received(can);
    write(regs.Btr, rate.Timing | (can.Loopback ? CO_BXCAN_BTR_LBKM | CO_BXCAN_BTR_SILM : 0));
    write(regs.Msr, CO_BXCAN_MSR_ERRI);
    can.Rate = &rate;
    enable_interrupts(can);
    write(regs.Mcr, CO_BXCAN_MCR_FREEZE | CO_BXCAN_MCR_RFLM |
                        (can.Recovery == CO_CAN_RECOVERY_AUTOMATIC ? CO_BXCAN_MCR_ABOM : 0));
  }

  static void init(Can& can) {
    leave_bus(can);
    open_filters(can);
    discard_received(can);
  }

  static void filter(const Can& can, const std::uint32_t* ids, unsigned num) {
    constexpr unsigned filters_in_bank = 2;
    set_filters(can, filters_of(ids, num, filters_in_bank * (can.BankNum - 1U)));
  }
};

using Driver = controller::Driver<Port>;

}  // namespace
}  // namespace co::bxcan

using namespace co;
using namespace co::bxcan;

const CO_IF_CAN_DRV_EX BxcanCanDriver = bxcan::Driver::table;

extern "C" {

void COCanBxcanInterrupt(CO_CAN_BXCAN* can) {
  ASSERT_PTR(can);
  if (can->Rate == nullptr) {
    return;
  }
  CO_BXCAN_REGISTERS& regs = *can->Registers;
  Port::receive(*can);
  if ((read(regs.Msr) & CO_BXCAN_MSR_ERRI) != 0) {
    write(regs.Msr, CO_BXCAN_MSR_ERRI);
    if ((read(regs.Esr) & CO_BXCAN_ESR_BOFF) != 0) {
      report::count_bus_off(can->Report);
    }
  }
  if ((read(regs.Ier) & CO_BXCAN_IER_TMEIE) != 0) {
    Mailboxes mailboxes(*can);
    transmit::finish(can->Transmit, mailboxes);
  }
}

bool COCanBxcanHasFrames(const CO_CAN_BXCAN* can) { return bxcan::Driver::has_frames(can); }
uint32_t COCanBxcanLost(const CO_CAN_BXCAN* can) { return bxcan::Driver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanBxcanErrors(const CO_CAN_BXCAN* can) { return bxcan::Driver::errors(can); }

}  // extern "C"
