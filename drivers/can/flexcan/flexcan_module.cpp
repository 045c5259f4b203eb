// SPDX-License-Identifier: Apache-2.0
// Modes of the controller, its configuration and filters.
#include "flexcan_controller.hpp"

namespace co::flexcan {
namespace {

// Limits of loops. The frame on the bus has to end before freeze mode is entered: 178 bit times at most. The number of
// reads is the limit if the timer, which counts bit times, stands still.
constexpr unsigned patience = 20000;
constexpr unsigned freeze_reads = 400000;
constexpr std::uint16_t freeze_bits = 256;

constexpr unsigned buffers_of_fifo = 8;
constexpr unsigned other_buffers = 4;  // the reserved one, and three for transmission
constexpr unsigned most_steps = 4;
constexpr unsigned most_buffers = 32;  // those of IFLAG1
constexpr std::uint32_t whole_mask = 0xFFFFFFFF;

// Waits until bits of MCR have a value.
void await(CO_FLEXCAN_REGISTERS& regs, std::uint32_t bits, std::uint32_t value) {
  unsigned left = patience;
  while (left != 0 && (read(regs.Mcr) & bits) != value) {
    --left;
  }
}

volatile std::uint32_t& word_at(CO_FLEXCAN_REGISTERS& regs, unsigned offset) {
  return reinterpret_cast<volatile std::uint32_t*>(&regs)[offset / sizeof(std::uint32_t)];
}

void clear(CO_FLEXCAN_REGISTERS& regs, unsigned first, unsigned end) {
  for (unsigned at = first; at < end; at += sizeof(std::uint32_t)) {
    write(word_at(regs, at), 0);
  }
}

std::uint32_t control2(const CO_CAN_FLEXCAN& can) {
  return (std::uint32_t{layout_of(can).steps} << CO_FLEXCAN_CTRL2_RFFN_SHIFT) | CO_FLEXCAN_CTRL2_TASD |
         CO_FLEXCAN_CTRL2_RRS | CO_FLEXCAN_CTRL2_EACEN | (can.IgnoreFd ? CO_FLEXCAN_CTRL2_PREXCEN : 0);
}

std::uint32_t module_configuration(const CO_CAN_FLEXCAN& can) {
  return CO_FLEXCAN_MCR_FRZ | CO_FLEXCAN_MCR_HALT | CO_FLEXCAN_MCR_IRMQ | CO_FLEXCAN_MCR_AEN |
         (uses_fifo(can) ? CO_FLEXCAN_MCR_RFEN : 0) | (can.Loopback ? 0 : CO_FLEXCAN_MCR_SRXDIS) |
         (can.RejectsAll ? CO_FLEXCAN_MCR_REJECT : 0) | (layout_of(can).transmit + CO_CAN_MAILBOXES - 1);
}

// Clears the write protection of MECR, and NCEFAFRZ: an error in memory must not stop the controller.
void configure_ecc(const CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  write(regs.Ctrl2, control2(can) | CO_FLEXCAN_CTRL2_ECRWRE);
  write(regs.Mecr, read(regs.Mecr) & ~CO_FLEXCAN_MECR_ECRWRDIS);
  write(regs.Mecr, read(regs.Mecr) & ~CO_FLEXCAN_MECR_NCEFAFRZ);
  write(regs.Mecr, read(regs.Mecr) | CO_FLEXCAN_MECR_ECRWRDIS);
  write(regs.Ctrl2, control2(can));
}

// Deactivates a message buffer that does not receive. After a remote frame was sent, its buffer receives: its mask
// admits no data frame, or the answer would be lost there.
void deactivate(CO_FLEXCAN_REGISTERS& regs, unsigned n) {
  write(regs.Iflag1, std::uint32_t{1} << n);
  write(regs.Mailbox[n].Control, CO_FLEXCAN_TX_INACTIVE);
  write(regs.Rximr[n], whole_mask);
}

// Makes a message buffer that receives free again. Its received identifier differs from its filter only in bits that
// are not compared.
void release(CO_FLEXCAN_MAILBOX& mailbox) {
  const std::uint32_t control = read(mailbox.Control);
  if ((control & CO_FLEXCAN_CODE) != CO_FLEXCAN_RX_INACTIVE) {
    write(mailbox.Control, CO_FLEXCAN_RX_EMPTY | (control & CO_FLEXCAN_IDE));
  }
}

void write_fifo_filters(CO_CAN_FLEXCAN& can, const Filters& all) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  volatile std::uint32_t* const table = &regs.Mailbox[CO_FLEXCAN_FIFO_FILTERS].Control;
  const Capacity capacity = capacity_of(can);
  const bool uses_global = all.number > capacity.masked;
  can.RejectsAll = all.number == 0;
  can.GlobalMask = uses_global ? standard_mask : whole_mask;
  for (unsigned n = 0; n < capacity.number; ++n) {
    const unsigned filler = n >= capacity.masked && uses_global ? capacity.masked : 0;
    const Filter& filter = all.filter[n < all.number ? n : filler];
    write(table[n], filter.word);
    if (n < capacity.masked) {
      write(regs.Rximr[n], filter.mask);
    }
  }
  write(regs.Rxfgmask, can.GlobalMask);
  write(regs.Mcr, module_configuration(can));
}

// Divides the message buffers that receive among the filters.
void write_mailbox_filters(const CO_CAN_FLEXCAN& can, const Filters& all) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  const Layout layout = layout_of(can);
  for (unsigned n = layout.receive; n < layout.transmit; ++n) {
    CO_FLEXCAN_MAILBOX& mailbox = regs.Mailbox[n];
    write(mailbox.Control, CO_FLEXCAN_RX_INACTIVE);
    if (all.number == 0) {
      continue;
    }
    const Filter& filter = all.filter[(n - layout.receive) % all.number];
    const std::uint32_t extended = (filter.word & CO_FLEXCAN_FIFO_IDE) != 0 ? CO_FLEXCAN_IDE : 0;
    write(mailbox.Identifier, (filter.word >> CO_FLEXCAN_FIFO_EXID_SHIFT) & CO_IF_FRM_ID);
    write(regs.Rximr[n],
          (filter.mask & CO_FLEXCAN_FIFO_IDE) | ((filter.mask >> CO_FLEXCAN_FIFO_EXID_SHIFT) & CO_IF_FRM_ID));
    write(mailbox.Control, CO_FLEXCAN_RX_EMPTY | extended);
  }
}

}  // namespace

Layout layout_of(const CO_CAN_FLEXCAN& can) {
  const unsigned buffers = can.MailboxNum < most_buffers ? can.MailboxNum : most_buffers;
  if (!uses_fifo(can)) {
    return {0, 0, 1, buffers - CO_CAN_MAILBOXES};
  }
  const unsigned possible = (buffers - buffers_of_fifo - other_buffers) / 2;
  const unsigned steps = possible < most_steps ? possible : most_steps;
  const unsigned reserved = buffers_of_fifo + 2 * steps;
  return {steps, reserved, reserved + 1, reserved + 1};
}

void soft_reset(CO_FLEXCAN_REGISTERS& regs) {
  write(regs.Mcr, read(regs.Mcr) | CO_FLEXCAN_MCR_SOFTRST);
  await(regs, CO_FLEXCAN_MCR_SOFTRST, 0);
  await(regs, CO_FLEXCAN_MCR_FRZACK, CO_FLEXCAN_MCR_FRZACK);
}

// The clock is selected while the module is disabled, a soft reset needs it enabled. [K20, 45.4.10.1: Freeze mode; SDK]
void start_module(const CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  const std::uint32_t source = can.BusClock ? CO_FLEXCAN_CTRL1_CLKSRC : 0;
  if ((read(regs.Ctrl1) & CO_FLEXCAN_CTRL1_CLKSRC) != source) {
    write(regs.Mcr, read(regs.Mcr) | CO_FLEXCAN_MCR_MDIS);
    await(regs, CO_FLEXCAN_MCR_LPMACK, CO_FLEXCAN_MCR_LPMACK);
    write(regs.Ctrl1, source);
  }
  if ((read(regs.Mcr) & CO_FLEXCAN_MCR_MDIS) != 0) {
    write(regs.Mcr, read(regs.Mcr) & ~CO_FLEXCAN_MCR_MDIS);
  }
  await(regs, CO_FLEXCAN_MCR_LPMACK, 0);
  soft_reset(regs);
}

bool request_freeze(const CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  write(regs.Mcr, read(regs.Mcr) | CO_FLEXCAN_MCR_FRZ | CO_FLEXCAN_MCR_HALT);
  const auto start = static_cast<std::uint16_t>(read(regs.Timer));
  for (unsigned left = freeze_reads; left != 0; --left) {
    if ((read(regs.Mcr) & CO_FLEXCAN_MCR_FRZACK) != 0) {
      return true;
    }
    if (static_cast<std::uint16_t>(read(regs.Timer) - start) > freeze_bits) {
      return false;
    }
  }
  return false;
}

void leave_freeze(CO_FLEXCAN_REGISTERS& regs) {
  write(regs.Mcr, read(regs.Mcr) & ~CO_FLEXCAN_MCR_HALT);
  await(regs, CO_FLEXCAN_MCR_FRZACK, 0);
}

void prepare_memory(const CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  if (!can.Ecc) {
    clear(regs, offsetof(CO_FLEXCAN_REGISTERS, Mailbox[0]),
          static_cast<unsigned>(offsetof(CO_FLEXCAN_REGISTERS, Mailbox[0]) +
                                sizeof(CO_FLEXCAN_MAILBOX) * can.MailboxNum));
    return;
  }
  write(regs.Ctrl2, control2(can) | CO_FLEXCAN_CTRL2_WRMFRZ);
  clear(regs, CO_FLEXCAN_MEMORY_FIRST, CO_FLEXCAN_MEMORY_END);
  clear(regs, can.EccFirst, can.EccEnd);
  write(regs.Ctrl2, control2(can));
  write(regs.Errsr, CO_FLEXCAN_ERRSR_ALL);
  configure_ecc(can);
}

void configure(const CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  const Layout layout = layout_of(can);
  write(regs.Mcr, module_configuration(can));
  write(regs.Ctrl2, control2(can));
  write(regs.Rxfgmask, can.GlobalMask);
  deactivate(regs, layout.reserved);
  for (unsigned n = layout.receive; n < layout.transmit; ++n) {
    release(regs.Mailbox[n]);
  }
  for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
    deactivate(regs, layout.transmit + n);
  }
}

Filters everything() {
  Filters all = {};
  all.number = 1;
  return all;
}

Capacity capacity_of(const CO_CAN_FLEXCAN& can) {
  const Layout layout = layout_of(can);
  if (uses_fifo(can)) {
    return {buffers_of_fifo * (layout.steps + 1), layout.reserved};
  }
  const unsigned half = (layout.transmit - layout.receive) / 2;
  return {half, half};
}

void write_filters(CO_CAN_FLEXCAN& can, const Filters& all) {
  uses_fifo(can) ? write_fifo_filters(can, all) : write_mailbox_filters(can, all);
}

}  // namespace co::flexcan
