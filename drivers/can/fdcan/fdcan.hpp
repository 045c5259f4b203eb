// SPDX-License-Identifier: Apache-2.0
/// \file fdcan.hpp
/// The port of controller::Driver for M_CAN, for each variant of its registers. Variant is a class with the register
/// structure, the interrupt bits and the layout of the message memory: see co_can_fdcan.cpp, co_can_mcan.cpp.
#ifndef CO_DRIVERS_FDCAN_HPP_
#define CO_DRIVERS_FDCAN_HPP_

#include <cstdint>

#include "../controller.hpp"
#include "../transmit.hpp"
#include "co_can_fdcan.h"
#include "fdcan_filters.hpp"

namespace co::fdcan {
/// \cond internal

// Limits of loops. The frame on the bus has to end before the controller goes off the bus; about 2 ms at 170 MHz.
inline constexpr unsigned status_reads = 20000;
inline constexpr unsigned fifo_reads = 64;

// Reads of a register after new filters were written: longer than a search of the filters.
inline constexpr unsigned search_reads = 32;

using registers::read;
using registers::write;

// Waits until bits of a register have a value. Returns false if they do not get it.
inline bool await_bits(const volatile std::uint32_t& reg, std::uint32_t bits, std::uint32_t value) {
  unsigned left = status_reads;
  while (left != 0 && (read(reg) & bits) != value) {
    --left;
  }
  return left != 0;
}

template <typename Variant>
class Port : public controller::MailboxPort<Port<Variant>, CO_CAN_FDCAN> {
  using Base = controller::MailboxPort<Port, CO_CAN_FDCAN>;
  using Registers = typename Variant::Registers;
  using State = report::State;

  // Interrupts that are always enabled on the bus; those of transmission are disabled while the loop uses the buffers.
  static constexpr std::uint32_t always_enabled =
      Variant::received | Variant::receive_lost | Variant::passive | Variant::bus_off;
  static constexpr std::uint32_t transmit_interrupts = Variant::sent | Variant::cancelled;
  static constexpr std::uint32_t enabled_on_bus = always_enabled | transmit_interrupts;

  static Registers& registers(const CO_CAN_FDCAN& can) { return *static_cast<Registers*>(can.Registers); }
  static volatile std::uint32_t* memory(const CO_CAN_FDCAN& can) { return can.Ram + can.RamOffset; }

  // Transmitting ------------------------------------------------------------------------------------------------------

  // Transmit buffers of a controller, for transmit.hpp.
  class Buffers {
   public:
    explicit Buffers(const CO_CAN_FDCAN& can)
        : can_(can), regs_(registers(can)), elements_(memory(can) + Variant::transmit_offset(can)) {}

    // A request is in TXBAR until the controller moves it to TXBRP.
    transmit::Completed take_completed(unsigned used) {
      const std::uint32_t added = read(regs_.Txbar);
      const std::uint32_t pending = added | read(regs_.Txbrp);
      if ((used & ~pending) == 0) {
        return {};
      }
      const std::uint32_t sent = read(regs_.Txbto);
      const std::uint32_t done = used & ~pending & (sent | read(regs_.Txbcf));
      return {done, sent & done};
    }

    // In queue mode the put index is that of the first free buffer.
    unsigned free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) {
      if (can_.WaitForIdle && is_receiver() && (read(regs_.Txbar) | read(regs_.Txbrp)) == 0) {
        return CO_CAN_MAILBOXES;
      }
      const std::uint32_t status = read(regs_.Txfqs);
      const unsigned put = (status >> CO_FDCAN_TXFQS_PUT_SHIFT) & CO_FDCAN_TXFQS_PUT;
      const bool is_free = (status & CO_FDCAN_TXFQS_FULL) == 0 && put < CO_CAN_MAILBOXES && (used & (1U << put)) == 0;
      return is_free ? put : CO_CAN_MAILBOXES;
    }

    void request(unsigned n, const CO_IF_FRM& frame) {
      volatile std::uint32_t* const element = elements_ + n * Variant::element_words;
      write(element[0], identifier_word(frame.Identifier));
      write(element[1], std::uint32_t{transmit::length_of(frame)} << CO_FDCAN_ELEMENT_DLC_SHIFT);
      write(element[2], transmit::word_at(frame.Data));
      write(element[3], transmit::word_at(frame.Data + 4));
      write(regs_.Txbar, 1U << n);
    }

    void abort(unsigned mailboxes) { write(regs_.Txbcr, mailboxes); }

    bool is_delayed(unsigned /*n*/) { return !can_.Loopback && is_receiver(); }

   private:
    bool is_receiver() { return (read(regs_.Psr) & CO_FDCAN_PSR_ACT) == CO_FDCAN_PSR_RECEIVER; }

    static std::uint32_t identifier_word(std::uint32_t identifier) {
      const std::uint32_t id = identifier & CO_IF_FRM_ID;
      const std::uint32_t remote = (identifier & CO_IF_FRM_RTR) != 0 ? CO_FDCAN_ELEMENT_RTR : 0;
      return transmit::is_extended(identifier) ? id | CO_FDCAN_ELEMENT_XTD | remote
                                               : (id << CO_FDCAN_ELEMENT_STD_SHIFT) | remote;
    }

    const CO_CAN_FDCAN& can_;
    Registers& regs_;
    volatile std::uint32_t* elements_;
  };

  // Receiving ---------------------------------------------------------------------------------------------------------

  static std::uint32_t identifier_of(std::uint32_t word) {
    const std::uint32_t remote = (word & CO_FDCAN_ELEMENT_RTR) != 0 ? CO_IF_FRM_RTR : 0;
    return (word & CO_FDCAN_ELEMENT_XTD) != 0 ? (word & CO_IF_FRM_ID) | CO_IF_FRM_EXT | remote
                                              : ((word & CO_IF_FRM_ID) >> CO_FDCAN_ELEMENT_STD_SHIFT) | remote;
  }

  // Moves a frame into the queue; CAN FD frames are discarded.
  static void receive_element(CO_CAN_FDCAN& can, const volatile std::uint32_t* element) {
    const std::uint32_t control = read(element[1]);
    if ((control & CO_FDCAN_ELEMENT_FDF) != 0) {
      return;
    }
    CO_IF_FRM frame{};
    frame.Identifier = identifier_of(read(element[0]));
    frame.DLC = transmit::length_of((control >> CO_FDCAN_ELEMENT_DLC_SHIFT) & CO_FDCAN_ELEMENT_DLC);
    transmit::unpack(read(element[2]), frame.Data);
    transmit::unpack(read(element[3]), frame.Data + 4);
    static_cast<void>(CORingPut(&can.Received, &frame));
  }

  // Filters -----------------------------------------------------------------------------------------------------------

  static void write_standard(volatile std::uint32_t* ram, unsigned n, std::uint32_t first, std::uint32_t last) {
    write(ram[n], CO_FDCAN_STANDARD_FIFO0 | (first << CO_FDCAN_STANDARD_FIRST_SHIFT) | last);
  }

  // Disables the filter while its words do not belong together.
  static void write_extended(volatile std::uint32_t* ram, unsigned n, std::uint32_t first, std::uint32_t last) {
    volatile std::uint32_t* const filter = &ram[standard_filters + 2 * n];
    write(filter[0], 0);
    write(filter[1], CO_FDCAN_EXTENDED_RANGE | last);
    write(filter[0], CO_FDCAN_EXTENDED_FIFO0 | first);
  }

  static void disable_standard(volatile std::uint32_t* ram, unsigned n) { write(ram[n], 0); }
  static void disable_extended(volatile std::uint32_t* ram, unsigned n) { write(ram[standard_filters + 2 * n], 0); }

  // Enables the last filters, which pass all frames.
  static void open_filters(volatile std::uint32_t* ram) {
    write_standard(ram, standard_filters - 1, 0, 0x7FF);
    write_extended(ram, extended_filters - 1, 0, CO_IF_FRM_ID);
  }

  // Replaces the filters. All frames pass meanwhile, and until a search that has begun before is over.
  static void set_filters(const CO_CAN_FDCAN& can, const Filters& all) {
    volatile std::uint32_t* const ram = memory(can);
    open_filters(ram);
    for (unsigned n = 0; n < standard_filters - 1; ++n) {
      n < all.standard.number ? write_standard(ram, n, all.standard.range[n].first, all.standard.range[n].last)
                              : disable_standard(ram, n);
    }
    for (unsigned n = 0; n < extended_filters - 1; ++n) {
      n < all.extended.number ? write_extended(ram, n, all.extended.range[n].first, all.extended.range[n].last)
                              : disable_extended(ram, n);
    }
    for (unsigned n = 0; n < search_reads; ++n) {
      static_cast<void>(read(registers(can).Crel));
    }
    disable_standard(ram, standard_filters - 1);
    disable_extended(ram, extended_filters - 1);
  }

 public:
  using Can = CO_CAN_FDCAN;
  using Mailboxes = Buffers;

  // The read-back ensures that the write has reached the controller, so no interrupt follows.
  static void disable_interrupts(const Can& can) {
    write(registers(can).Ie, 0);
    static_cast<void>(read(registers(can).Ie));
  }
  static void enable_receive_interrupts(const Can& can) { write(registers(can).Ie, always_enabled); }
  static void enable_interrupts(const Can& can) { write(registers(can).Ie, enabled_on_bus); }

  static bool is_bus_off(const Can& can) { return (read(registers(can).Psr) & CO_FDCAN_PSR_BO) != 0; }

  static State poll(const Can& can) {
    const std::uint32_t status = read(registers(can).Psr);
    if ((status & CO_FDCAN_PSR_BO) != 0) {
      return State::bus_off;
    }
    return (status & CO_FDCAN_PSR_EP) != 0 ? State::passive : State::active;
  }

  static CO_CAN_ERROR_COUNTERS errors(const Can& can) {
    constexpr std::uint8_t passive = 128;
    const std::uint32_t errors = read(registers(can).Ecr);
    return {CO_FDCAN_ECR_TEC(errors), (errors & CO_FDCAN_ECR_RP) != 0 ? passive : CO_FDCAN_ECR_REC(errors)};
  }

  static void receive(Can& can) {
    Registers& regs = registers(can);
    for (unsigned n = 0; n < fifo_reads; ++n) {
      const std::uint32_t status = read(regs.Rxf0s);
      if ((status & CO_FDCAN_RXF0S_LEVEL) == 0) {
        return;
      }
      const std::uint32_t index = (status >> CO_FDCAN_RXF0S_GET_SHIFT) & CO_FDCAN_RXF0S_GET;
      receive_element(can, memory(can) + CO_FDCAN_RAM_RECEIVE + index * Variant::element_words);
      write(regs.Rxf0a, index);
    }
  }

  static void discard_received(Can& can) {
    Base::discard_received(can);
    write(registers(can).Ir, Variant::received | Variant::receive_lost);
  }

  // Refuses frames until the controller has left the initialisation.
  static bool accept(Can& can, const CO_IF_FRM& frame) {
    return (read(registers(can).Cccr) & CO_FDCAN_CCCR_INIT) == 0 && Base::accept(can, frame);
  }

  // Goes off the bus after the frame on the wire, and enables changes of the configuration. The mode bits of CCCR are
  // write-protected until both INIT and CCE are set, so they are written unchanged. [M_CAN, 2.3.7]
  static void leave_bus(Can& can) {
    Registers& regs = registers(can);
    disable_interrupts(can);
    can.Rate = nullptr;
    if ((read(regs.Cccr) & CO_FDCAN_CCCR_INIT) == 0) {
      write(regs.Txbcr, transmit::all_mailboxes);
      static_cast<void>(await_bits(regs.Txbrp, transmit::all_mailboxes, 0));
    }
    write(regs.Cccr, read(regs.Cccr) | CO_FDCAN_CCCR_INIT);
    static_cast<void>(await_bits(regs.Cccr, CO_FDCAN_CCCR_INIT, CO_FDCAN_CCCR_INIT));
    write(regs.Cccr, read(regs.Cccr) | CO_FDCAN_CCCR_CCE);
    transmit::forget(can.Transmit);
  }

  static void join_bus(Can& can, const CO_CAN_FDCAN_RATE& rate) {
    Registers& regs = registers(can);
    const std::uint32_t mode =
        CO_FDCAN_CCCR_FDOE | (can.Loopback ? CO_FDCAN_CCCR_TEST | CO_FDCAN_CCCR_MON : std::uint32_t{0});
    leave_bus(can);
    discard_received(can);
    write(regs.Nbtp, rate.Timing);
    if (can.DataTiming != 0) {
      write(regs.Dbtp, can.DataTiming);
    }
    Variant::configure(can);
    write(regs.Cccr, CO_FDCAN_CCCR_INIT | CO_FDCAN_CCCR_CCE | mode);
    if (can.Loopback) {
      write(regs.Test, CO_FDCAN_TEST_LBCK);
    }
    write(regs.Txbtie, transmit::all_mailboxes);
    write(regs.Txbcie, transmit::all_mailboxes);
    write(regs.Ils, 0);
    write(regs.Ile, CO_FDCAN_ILE_LINE0);
    write(regs.Ir, enabled_on_bus);
    can.Rate = &rate;
    enable_interrupts(can);
    write(regs.Cccr, mode);
  }

  static void init(Can& can) {
    leave_bus(can);
    volatile std::uint32_t* const ram = memory(can);
    for (unsigned n = 0; n < Variant::words(can); ++n) {
      write(ram[n], 0);
    }
    open_filters(ram);
    discard_received(can);
  }

  static void filter(const Can& can, const std::uint32_t* ids, unsigned num) { set_filters(can, filters_of(ids, num)); }

  static void interrupt(Can& can) {
    if (can.Rate == nullptr) {
      return;
    }
    Registers& regs = registers(can);
    const std::uint32_t enabled = read(regs.Ie);
    const std::uint32_t active = read(regs.Ir) & enabled;
    write(regs.Ir, active);
    receive(can);
    if ((active & Variant::receive_lost) != 0) {
      report::count_overflow(can.Report);
    }
    if ((active & Variant::bus_off) != 0 && is_bus_off(can)) {
      report::count_bus_off(can.Report);
      if (can.Recovery == CO_CAN_RECOVERY_AUTOMATIC) {
        write(regs.Cccr, read(regs.Cccr) & ~CO_FDCAN_CCCR_INIT);
      }
    }
    const bool has_displaced = can.Transmit.DisplacedNum != 0 && (enabled & transmit_interrupts) != 0;
    if ((active & transmit_interrupts) != 0 || has_displaced) {
      Buffers buffers(can);
      transmit::finish(can.Transmit, buffers);
    }
  }
};

/// \endcond
}  // namespace co::fdcan

#endif
