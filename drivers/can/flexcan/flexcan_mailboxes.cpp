// SPDX-License-Identifier: Apache-2.0
// Transmission through three message buffers, and reception.
#include "../controller.hpp"
#include "flexcan_controller.hpp"

namespace co::flexcan {
namespace {

// Limits of loops.
constexpr unsigned fifo_reads = 32;
constexpr unsigned passes = 8;
constexpr unsigned busy_reads = 64;
constexpr unsigned idle_reads = 200;  // longer than a bit at 125 kbit/s and more

constexpr unsigned most_received = 28;

// Data words have their first byte in the highest bits.
std::uint32_t swapped(std::uint32_t word) {
  return (word >> 24) | ((word >> 8) & 0xFF00U) | ((word << 8) & 0xFF0000U) | (word << 24);
}

std::uint32_t identifier_word(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  return transmit::is_extended(identifier) ? id : id << CO_FLEXCAN_STID_SHIFT;
}

// SRR is recessive in frames with an identifier of 29 bits. [K20, 45.3: SRR]
std::uint32_t control_word(const CO_IF_FRM& frame) {
  const std::uint32_t remote = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? CO_FLEXCAN_RTR : 0;
  const std::uint32_t extended = transmit::is_extended(frame.Identifier) ? CO_FLEXCAN_IDE | CO_FLEXCAN_SRR : 0;
  return CO_FLEXCAN_TX_DATA | remote | extended | (std::uint32_t{transmit::length_of(frame)} << CO_FLEXCAN_DLC_SHIFT);
}

CO_IF_FRM read_frame(std::uint32_t control, const CO_FLEXCAN_MAILBOX& mailbox) {
  CO_IF_FRM frame{};
  const std::uint32_t id = read(mailbox.Identifier) & CO_IF_FRM_ID;
  frame.Identifier = (control & CO_FLEXCAN_IDE) != 0 ? id | CO_IF_FRM_EXT : id >> CO_FLEXCAN_STID_SHIFT;
  frame.Identifier |= (control & CO_FLEXCAN_RTR) != 0 ? CO_IF_FRM_RTR : 0;
  frame.DLC = transmit::length_of((control >> CO_FLEXCAN_DLC_SHIFT) & CO_FLEXCAN_DLC);
  transmit::unpack(swapped(read(mailbox.Data[0])), frame.Data);
  transmit::unpack(swapped(read(mailbox.Data[1])), frame.Data + 4);
  return frame;
}

// Moves the frames of the FIFO into the queue. [K20, 45.4.3: Receive process]
void receive_fifo(CO_CAN_FLEXCAN& can) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  for (unsigned n = 0; n < fifo_reads; ++n) {
    const std::uint32_t flags = read(regs.Iflag1);
    if ((flags & CO_FLEXCAN_IFLAG_OVERFLOW) != 0) {
      write(regs.Iflag1, CO_FLEXCAN_IFLAG_OVERFLOW);
      report::count_overflow(can.Report);
    }
    if ((flags & CO_FLEXCAN_IFLAG_FRAME) == 0) {
      return;
    }
    const CO_FLEXCAN_MAILBOX& output = regs.Mailbox[0];
    const CO_IF_FRM frame = read_frame(read(output.Control), output);
    write(regs.Iflag1, CO_FLEXCAN_IFLAG_FRAME);
    static_cast<void>(CORingPut(&can.Received, &frame));
  }
}

// Received frames, the oldest first.
struct Batch {
  CO_IF_FRM frame[most_received];
  std::uint16_t stamp[most_received];
  unsigned number;
};

void insert(Batch& batch, const CO_IF_FRM& frame, std::uint16_t stamp) {
  unsigned at = batch.number++;
  for (; at != 0 && static_cast<std::int16_t>(stamp - batch.stamp[at - 1]) < 0; --at) {
    batch.frame[at] = batch.frame[at - 1];
    batch.stamp[at] = batch.stamp[at - 1];
  }
  batch.frame[at] = frame;
  batch.stamp[at] = stamp;
}

// Reads a message buffer. The read of its control word locks it, that of the timer unlocks it: it is free to receive
// then, although its code stays FULL. It must not be set to EMPTY. [K20, 45.4.3: Receive process]
void read_mailbox(CO_CAN_FLEXCAN& can, unsigned n, Batch& batch) {
  CO_FLEXCAN_REGISTERS& regs = *can.Registers;
  const CO_FLEXCAN_MAILBOX& mailbox = regs.Mailbox[n];
  std::uint32_t control = read(mailbox.Control);
  for (unsigned left = busy_reads; left != 0 && (control & CO_FLEXCAN_RX_BUSY) != 0; --left) {
    control = read(mailbox.Control);
  }
  insert(batch, read_frame(control, mailbox), static_cast<std::uint16_t>(control));
  write(regs.Iflag1, std::uint32_t{1} << n);
  static_cast<void>(read(regs.Timer));
  if ((control & CO_FLEXCAN_CODE) == CO_FLEXCAN_RX_OVERRUN) {
    report::count_overflow(can.Report);
  }
}

// Moves the frames of message buffers whose flags are set into the queue, in the order of their time stamps.
void receive_flagged(CO_CAN_FLEXCAN& can, const Layout& layout, std::uint32_t flags) {
  Batch batch = {};
  for (unsigned n = layout.receive; n < layout.transmit; ++n) {
    if ((flags & (std::uint32_t{1} << n)) != 0) {
      read_mailbox(can, n, batch);
    }
  }
  for (unsigned n = 0; n < batch.number; ++n) {
    static_cast<void>(CORingPut(&can.Received, &batch.frame[n]));
  }
}

// Empties the message buffers. A frame that arrives meanwhile is newer than all of the same pass.
void receive_mailboxes(CO_CAN_FLEXCAN& can) {
  const Layout layout = layout_of(can);
  for (unsigned pass = 0; pass < passes; ++pass) {
    const std::uint32_t flags = read(can.Registers->Iflag1) & receive_bits(layout);
    if (flags == 0) {
      return;
    }
    receive_flagged(can, layout, flags);
  }
}

}  // namespace

void receive(CO_CAN_FLEXCAN& can) { uses_fifo(can) ? receive_fifo(can) : receive_mailboxes(can); }

// The flag of a buffer is set when its frame was sent or aborted; some versions of the controller set no flag for a
// frame that was aborted before the transmission began. A buffer that has sent a remote frame becomes one that
// receives: it is deactivated. [K20, tables 45-70 and 45-71]
transmit::Completed Mailboxes::take_completed(unsigned used) {
  const std::uint32_t flags = read(regs_.Iflag1);
  transmit::Completed completed = {};
  for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
    if ((used & (1U << n)) == 0) {
      continue;
    }
    const std::uint32_t now = code(n);
    const bool is_aborted = now == CO_FLEXCAN_TX_ABORT;
    if (now == CO_FLEXCAN_TX_DATA || (!is_aborted && (flags & flag(n)) == 0)) {
      continue;
    }
    write(regs_.Iflag1, flag(n));
    if (!is_aborted && now != CO_FLEXCAN_TX_INACTIVE) {
      write(mailbox(n).Control, CO_FLEXCAN_TX_INACTIVE);
    }
    completed.done |= 1U << n;
    completed.sent |= is_aborted ? 0 : 1U << n;
  }
  return completed;
}

unsigned Mailboxes::free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) {
  unsigned n = 0;
  while (n < CO_CAN_MAILBOXES && (used & (1U << n)) != 0) {
    ++n;
  }
  return n;
}

// A set flag would block the write of the control word. The reserved buffer is written twice after each request, or
// the controller could miss the request (errata 5641 and 5829). [K20, 45.4.1: Transmit process]
void Mailboxes::request(unsigned n, const CO_IF_FRM& frame) {
  CO_FLEXCAN_MAILBOX& target = mailbox(n);
  write(regs_.Iflag1, flag(n));
  write(target.Identifier, identifier_word(frame.Identifier));
  write(target.Data[0], swapped(transmit::word_at(frame.Data)));
  write(target.Data[1], swapped(transmit::word_at(frame.Data + 4)));
  write(target.Control, control_word(frame));
  write(regs_.Mailbox[layout_.reserved].Control, CO_FLEXCAN_TX_INACTIVE);
  write(regs_.Mailbox[layout_.reserved].Control, CO_FLEXCAN_TX_INACTIVE);
}

// Waits until a frame that the controller is about to begin is on the bus: to abort it on an idle bus could send a
// frame with a wrong identifier (erratum 6032).
void Mailboxes::wait_for_start() {
  unsigned left = idle_reads;
  while (left != 0 && (read(regs_.Esr1) & CO_FLEXCAN_ESR1_IDLE) != 0) {
    --left;
  }
}

// In freeze mode nothing is transmitted: configure() deactivates the buffers. The memory may be uninitialised there.
void Mailboxes::abort(unsigned mailboxes) {
  if ((read(regs_.Mcr) & CO_FLEXCAN_MCR_FRZACK) != 0) {
    return;
  }
  bool waits = true;
  for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
    if ((mailboxes & (1U << n)) == 0 || code(n) != CO_FLEXCAN_TX_DATA) {
      continue;
    }
    if (waits) {
      wait_for_start();
      waits = false;
    }
    const std::uint32_t control = read(mailbox(n).Control);
    if ((control & CO_FLEXCAN_CODE) == CO_FLEXCAN_TX_DATA) {
      write(mailbox(n).Control, (control & ~CO_FLEXCAN_CODE) | CO_FLEXCAN_TX_ABORT);
    }
  }
}

bool Mailboxes::is_delayed(unsigned /*n*/) { return !is_loopback_ && (read(regs_.Esr1) & CO_FLEXCAN_ESR1_RX) != 0; }

unsigned Mailboxes::hold(const CO_CAN_TRANSMIT& box) {
  unsigned held = 0;
  for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
    held |= (box.Used & (1U << n)) != 0 && code(n) == CO_FLEXCAN_TX_DATA ? 1U << n : 0;
  }
  abort(held);
  return held & ~unsigned{box.Dropped};
}

void Mailboxes::resume(const CO_CAN_TRANSMIT& box, unsigned held) {
  for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
    if ((held & (1U << n)) != 0 && code(n) == CO_FLEXCAN_TX_ABORT) {
      request(n, box.Frame[n]);
    }
  }
}

}  // namespace co::flexcan
