// SPDX-License-Identifier: Apache-2.0
#include "co_can_mcp2515.h"

#include <cstdint>

#include "../report.hpp"
#include "../transmit.hpp"
#include "mcp2515_filters.hpp"

// The controller can abort all buffers only: those that were not chosen need places, too.
template <>
inline constexpr unsigned co::transmit::room_of<CO_MCP2515_TRANSMIT> = CO_CAN_DISPLACED;

namespace co::mcp2515 {
namespace {

using Can = CO_CAN_MCP2515;
using report::State;

constexpr std::int16_t one_frame = sizeof(CO_IF_FRM);

// Limits of loops. The frame on the wire has to end before the controller goes off the bus.
constexpr unsigned status_reads = 20000;
constexpr unsigned service_rounds = 8;
constexpr unsigned buffer_reads = 8;

constexpr std::uint8_t no_answer = 0xFF;  // of a controller that is not connected
constexpr std::uint8_t overflows = CO_MCP2515_EFLG_RX0OVR | CO_MCP2515_EFLG_RX1OVR;
constexpr std::uint8_t receive_interrupts = CO_MCP2515_INT_RX(0) | CO_MCP2515_INT_RX(1);
constexpr std::uint8_t transmit_interrupts = CO_MCP2515_INT_TX(0) | CO_MCP2515_INT_TX(1) | CO_MCP2515_INT_TX(2);
constexpr std::uint8_t all_interrupts = receive_interrupts | transmit_interrupts | CO_MCP2515_INT_ERR;

constexpr unsigned header_bytes = 5;  // SIDH, SIDL, EID8, EID0, DLC

Can& controller(void* ctx) { return *static_cast<Can*>(ctx); }

// SPI -----------------------------------------------------------------------------------------------------------------

// A transaction: CS is low during its life.
class Transaction {
 public:
  explicit Transaction(const Can& can) : can_(can) { can_.Spi->Select(can_.SpiCtx, true); }
  ~Transaction() { can_.Spi->Select(can_.SpiCtx, false); }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void transfer(std::uint8_t* bytes, unsigned number) {
    can_.Spi->Transfer(can_.SpiCtx, bytes, static_cast<std::uint8_t>(number));
  }

 private:
  const Can& can_;
};

template <unsigned number>
void transact(const Can& can, std::uint8_t (&bytes)[number]) {
  Transaction transaction(can);
  transaction.transfer(bytes, number);
}

std::uint8_t read(const Can& can, std::uint8_t address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, address, 0};
  transact(can, bytes);
  return bytes[2];
}

// Two neighbouring registers.
struct TwoRegisters {
  std::uint8_t first;
  std::uint8_t second;
};

TwoRegisters read_two(const Can& can, std::uint8_t address) {
  std::uint8_t bytes[] = {CO_MCP2515_READ, address, 0, 0};
  transact(can, bytes);
  return {bytes[2], bytes[3]};
}

std::uint8_t read_status(const Can& can) {
  std::uint8_t bytes[] = {CO_MCP2515_READ_STATUS, 0};
  transact(can, bytes);
  return bytes[1];
}

void write(const Can& can, std::uint8_t address, unsigned value) {
  std::uint8_t bytes[] = {CO_MCP2515_WRITE, address, static_cast<std::uint8_t>(value)};
  transact(can, bytes);
}

void clear_bits(const Can& can, std::uint8_t address, unsigned bits) {
  std::uint8_t bytes[] = {CO_MCP2515_BIT_MODIFY, address, static_cast<std::uint8_t>(bits), 0};
  transact(can, bytes);
}

void command(const Can& can, unsigned instruction) {
  std::uint8_t bytes[] = {static_cast<std::uint8_t>(instruction)};
  transact(can, bytes);
}

void write_control(const Can& can, unsigned bits) {
  write(can, CO_MCP2515_CANCTRL, bits | (can.ClockOutput & CO_MCP2515_CLOCK_OUTPUT));
}

// Use of SPI by loop and interrupt ------------------------------------------------------------------------------------

CO_MCP2515_BUS& bus_of(Can& can) { return can.Bus != nullptr ? *can.Bus : can.State.OwnBus; }

void service(Can& can);

// Does the work of the interrupts that have occurred while SPI was in use.
void work_off(const CO_MCP2515_BUS& bus) {
  for (Can* can = bus.First; can != nullptr; can = can->State.Next) {
    if (report::load(can->State.IsMissed) != 0) {
      report::store(can->State.IsMissed, std::uint8_t{0});
      service(*can);
    }
  }
}

// An interrupt may occur at any point, but it ends before this context continues, with the same value of Holds.
void hold(CO_MCP2515_BUS& bus) { report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds + 1)); }

bool has_notes(const CO_MCP2515_BUS& bus) {
  for (const Can* can = bus.First; can != nullptr; can = can->State.Next) {
    if (report::load(can->State.IsMissed) != 0) {
      return true;
    }
  }
  return false;
}

// Does the work of the interrupts that have occurred since hold(), unless this context has interrupted another user.
void release(CO_MCP2515_BUS& bus) {
  report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  while (bus.Holds == 0 && has_notes(bus)) {
    hold(bus);
    work_off(bus);
    report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  }
}

// The use of SPI by a function of the driver: the interrupts do not use it meanwhile.
class Exclusive {
 public:
  explicit Exclusive(Can& can) : bus_(bus_of(can)) { hold(bus_); }
  ~Exclusive() { release(bus_); }
  Exclusive(const Exclusive&) = delete;
  Exclusive& operator=(const Exclusive&) = delete;

 private:
  CO_MCP2515_BUS& bus_;
};

// Transmitting --------------------------------------------------------------------------------------------------------

// Transmit buffers of a controller, for transmit.hpp. Among the requested ones, the controller sends that with the
// highest priority TXP first, among equal ones that with the highest number. [MCP2515, 3.2]
class Buffers {
 public:
  explicit Buffers(Can& can) : can_(can) {}

  // A buffer without request has been sent if TXnIF is set; otherwise it was aborted.
  transmit::Completed take_completed(unsigned used) {
    if (used == 0 && can_.State.IsAborting == 0) {
      return {};
    }
    const unsigned status = read_status(can_);
    if (status == no_answer) {
      return {};
    }
    transmit::Completed completed = {};
    unsigned acknowledged = 0;
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if ((used & (1U << n)) == 0 || (status & CO_MCP2515_STATUS_TXREQ(n)) != 0) {
        continue;
      }
      completed.done |= 1U << n;
      if ((status & CO_MCP2515_STATUS_TXIF(n)) != 0) {
        completed.sent |= 1U << n;
        acknowledged |= CO_MCP2515_INT_TX(n);
      }
    }
    if (acknowledged != 0) {
      clear_bits(can_, CO_MCP2515_CANINTF, acknowledged);
    }
    if (can_.State.IsAborting != 0 && (status & CO_MCP2515_STATUS_PENDING) == 0) {
      end_abort();
    }
    return completed;
  }

  // Selects a buffer and its priority, so that the frames are sent in the order of their identifiers. None is returned
  // if the frames in the buffers have neighbouring places in that order.
  unsigned free_mailbox(unsigned used, const CO_IF_FRM& frame) {
    if (can_.State.IsAborting != 0) {
      return CO_CAN_MAILBOXES;
    }
    int above = -1;
    int below = places;
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if ((used & (1U << n)) == 0) {
        continue;
      }
      const int place = can_.State.Priority[n] * CO_CAN_MAILBOXES + static_cast<int>(n);
      const bool is_before = transmit::rank(can_.State.Transmit.Frame[n].Identifier) < transmit::rank(frame.Identifier);
      below = is_before && place < below ? place : below;
      above = !is_before && place > above ? place : above;
    }
    return place_between(used, above, below);
  }

  // CS rises at the end of the instruction RTS, which has no other byte. [Errata, 5]
  void request(unsigned n, const CO_IF_FRM& frame) {
    std::uint8_t bytes[3 + header_bytes + transmit::bytes_at_most] = {
        CO_MCP2515_WRITE, static_cast<std::uint8_t>(CO_MCP2515_TXCTRL(n)), can_.State.Priority[n]};
    put_header(frame, bytes + 3);
    const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
    const unsigned length = is_remote ? 0 : transmit::length_of(frame);
    for (unsigned i = 0; i < length; ++i) {
      bytes[3 + header_bytes + i] = frame.Data[i];
    }
    {
      Transaction transaction(can_);
      transaction.transfer(bytes, 3 + header_bytes + length);
    }
    command(can_, CO_MCP2515_RTS(n));
  }

  // The controller aborts all buffers but that on the wire, for which take_completed() has no result yet. The request
  // to abort a single one, TXREQ = 0, would not show whether its frame is on the wire.
  void abort(unsigned /*mailboxes*/) {
    begin_abort();
    end_abort();
    can_.State.Transmit.Aborting = can_.State.Transmit.Used;
  }

  void begin_abort() {
    can_.State.IsAborting = 1;
    write_control(can_, mode() | CO_MCP2515_ABAT);
  }

  void end_abort() {
    can_.State.IsAborting = 0;
    write_control(can_, mode());
  }

  // The controller does not show whether another node is transmitting.
  bool is_delayed(unsigned n) {
    const unsigned control = read(can_, static_cast<std::uint8_t>(CO_MCP2515_TXCTRL(n)));
    return !can_.Loopback && (control & CO_MCP2515_TXCTRL_MLOA) != 0;
  }

 private:
  static constexpr int priorities = 4;
  static constexpr int places = priorities * CO_CAN_MAILBOXES;  // in the order of transmission, the last is the first

  unsigned mode() const { return can_.Loopback ? CO_MCP2515_MODE_LOOPBACK : CO_MCP2515_MODE_NORMAL; }

  // Returns the free buffer whose place is nearest to the middle between two others.
  unsigned place_between(unsigned used, int above, int below) {
    unsigned best = CO_CAN_MAILBOXES;
    int least = places;
    for (int place = above + 1; place < below; ++place) {
      const unsigned n = static_cast<unsigned>(place) % CO_CAN_MAILBOXES;
      const int from_middle = 2 * place - (above + below);
      const int distance = from_middle < 0 ? -from_middle : from_middle;
      if ((used & (1U << n)) == 0 && distance < least) {
        least = distance;
        best = n;
        can_.State.Priority[n] = static_cast<std::uint8_t>(place / CO_CAN_MAILBOXES);
      }
    }
    return best;
  }

  static void put_header(const CO_IF_FRM& frame, std::uint8_t* bytes) {
    const std::uint32_t id = frame.Identifier & CO_IF_FRM_ID;
    const bool is_extended = transmit::is_extended(frame.Identifier);
    const std::uint32_t word = is_extended ? id : id << 18;
    const unsigned remote = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? CO_MCP2515_DLC_RTR : 0;
    bytes[0] = static_cast<std::uint8_t>(word >> 21);
    bytes[1] = static_cast<std::uint8_t>((word >> 13 & 0xE0) | (is_extended ? CO_MCP2515_SIDL_EXIDE : 0) |
                                         (word >> 16 & 0x03));
    bytes[2] = static_cast<std::uint8_t>(word >> 8);
    bytes[3] = static_cast<std::uint8_t>(word);
    bytes[4] = static_cast<std::uint8_t>(remote | transmit::length_of(frame));
  }

  Can& can_;
};

// Requests the frames that wait.
void request_waiting(Can& can) {
  if (can.State.IsBusOff == 0) {
    Buffers buffers(can);
    transmit::finish(can.State.Transmit, buffers);
  }
}

// Receiving -----------------------------------------------------------------------------------------------------------

CO_IF_FRM frame_of(const std::uint8_t* header) {
  CO_IF_FRM frame{};
  const bool is_extended = (header[1] & CO_MCP2515_SIDL_EXIDE) != 0;
  const std::uint32_t base = (std::uint32_t{header[0]} << 3) | (header[1] >> 5);
  const bool is_remote = is_extended ? (header[4] & CO_MCP2515_DLC_RTR) != 0 : (header[1] & CO_MCP2515_SIDL_SRR) != 0;
  const std::uint32_t extension =
      (std::uint32_t{header[1] & 0x03U} << 16) | (std::uint32_t{header[2]} << 8) | header[3];
  frame.Identifier = (is_extended ? (base << 18) | extension | CO_IF_FRM_EXT : base) | (is_remote ? CO_IF_FRM_RTR : 0);
  const unsigned length = header[4] & CO_MCP2515_DLC_LENGTH;
  frame.DLC = static_cast<std::uint8_t>(length < transmit::bytes_at_most ? length : transmit::bytes_at_most);
  return frame;
}

// Moves a frame into the queue. CS that rises frees the buffer.
void take_frame(Can& can, unsigned buffer) {
  std::uint8_t bytes[1 + header_bytes] = {static_cast<std::uint8_t>(CO_MCP2515_READ_RX(buffer))};
  CO_IF_FRM frame{};
  {
    Transaction transaction(can);
    transaction.transfer(bytes, sizeof bytes);
    frame = frame_of(bytes + 1);
    if (frame.DLC != 0 && (frame.Identifier & CO_IF_FRM_RTR) == 0) {
      transaction.transfer(frame.Data, frame.DLC);
    }
  }
  static_cast<void>(CORingPut(&can.State.Received, &frame));
}

// Moves the received frames into the queue. Buffer 1 receives the next frame while buffer 0 is full: if it has one when
// buffer 0 is freed, that frame is older than the next one in buffer 0.
void receive(Can& can, unsigned flags) {
  bool is_second_older = false;
  for (unsigned n = 0; n < buffer_reads && (flags & receive_interrupts) != 0; ++n) {
    const bool has_both = (flags & receive_interrupts) == receive_interrupts;
    const unsigned buffer = (flags & CO_MCP2515_INT_RX(0)) == 0 || (has_both && is_second_older) ? 1 : 0;
    take_frame(can, buffer);
    if (buffer == 0) {
      flags = read_status(can);
      is_second_older = true;
    } else {
      flags &= ~unsigned{CO_MCP2515_INT_RX(1)};
      is_second_older = false;
    }
  }
}

// Filters -------------------------------------------------------------------------------------------------------------

Filters filters(const Can& can) {
  Filters all = {};
  for (unsigned n = 0; n < filter_number; ++n) {
    all.word[n] = can.State.FilterWord[n];
  }
  for (unsigned n = 0; n < receive_buffers; ++n) {
    all.mask[n] = can.State.FilterMask[n];
  }
  return all;
}

void store_filters(Can& can, const Filters& all) {
  for (unsigned n = 0; n < filter_number; ++n) {
    can.State.FilterWord[n] = all.word[n];
  }
  for (unsigned n = 0; n < receive_buffers; ++n) {
    can.State.FilterMask[n] = all.mask[n];
  }
}

// Writes neighbouring filters or masks.
void write_words(const Can& can, unsigned address, const std::uint32_t* words, unsigned number) {
  for (unsigned n = 0; n < number; ++n) {
    const std::uint32_t word = words[n];
    std::uint8_t bytes[] = {CO_MCP2515_WRITE,
                            static_cast<std::uint8_t>(address + 4 * n),
                            static_cast<std::uint8_t>(word >> 21),
                            static_cast<std::uint8_t>((word >> 13 & 0xE0) | (word >> 16 & 0x03) |
                                                      ((word & extended_bit) != 0 ? CO_MCP2515_SIDL_EXIDE : 0)),
                            static_cast<std::uint8_t>(word >> 8),
                            static_cast<std::uint8_t>(word)};
    transact(can, bytes);
  }
}

// Modes ---------------------------------------------------------------------------------------------------------------

bool await_configuration(const Can& can) {
  unsigned left = status_reads;
  while (left != 0 && (read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE) != CO_MCP2515_MODE_CONFIGURATION) {
    --left;
  }
  return left != 0;
}

// Aborts the frames that are not on the wire and waits for the end of that on the wire. Results are stored.
void await_idle_buffers(Can& can) {
  Buffers buffers(can);
  buffers.begin_abort();
  unsigned left = status_reads;
  while (left != 0 && can.State.IsAborting != 0) {
    transmit::collect(can.State.Transmit, buffers);
    --left;
  }
}

// Goes off the bus after the frame on the wire. A controller that does not follow is reset. Frames that were not sent
// are displaced.
void enter_configuration(Can& can) {
  const unsigned mode = read(can, CO_MCP2515_CANSTAT) & CO_MCP2515_MODE;
  if (mode == CO_MCP2515_MODE_NORMAL || mode == CO_MCP2515_MODE_LOOPBACK) {
    await_idle_buffers(can);
  }
  write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  if (!await_configuration(can)) {
    command(can, CO_MCP2515_RESET);
    static_cast<void>(await_configuration(can));
    write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  }
  can.State.IsAborting = 0;
  transmit::take_back(can.State.Transmit);
}

// Writes all registers that determine the function of the controller, which is in Configuration mode. Returns false if
// it does not answer.
bool write_configuration(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  std::uint8_t timing[] = {CO_MCP2515_WRITE, CO_MCP2515_CNF3, static_cast<std::uint8_t>(rate.Timing),
                           static_cast<std::uint8_t>(rate.Timing >> 8), static_cast<std::uint8_t>(rate.Timing >> 16)};
  const std::uint8_t written[] = {timing[2], timing[3], timing[4]};
  transact(can, timing);
  std::uint8_t present[] = {CO_MCP2515_READ, CO_MCP2515_CNF3, 0, 0, 0};
  transact(can, present);
  write(can, static_cast<std::uint8_t>(CO_MCP2515_RXCTRL(0)), CO_MCP2515_RXCTRL_BUKT);
  write(can, static_cast<std::uint8_t>(CO_MCP2515_RXCTRL(1)), 0);
  write_words(can, CO_MCP2515_FILTERS, can.State.FilterWord, 3);
  write_words(can, CO_MCP2515_FILTERS3, can.State.FilterWord + 3, 3);
  write_words(can, CO_MCP2515_MASKS, can.State.FilterMask, receive_buffers);
  write(can, CO_MCP2515_CANINTE, all_interrupts);
  can.State.IsErrorMasked = 0;
  can.State.NeedsFilters = 0;
  return present[2] == written[0] && present[3] == written[1] && present[4] == written[2];
}

void leave_configuration(const Can& can) {
  write_control(can, can.Loopback ? CO_MCP2515_MODE_LOOPBACK : CO_MCP2515_MODE_NORMAL);
}

// Errors --------------------------------------------------------------------------------------------------------------

CO_CAN_ERROR_COUNTERS read_errors(const Can& can) {
  const TwoRegisters counters = read_two(can, CO_MCP2515_TEC);
  return {counters.first, counters.second};
}

bool is_bus_off(const Can& can) { return can.State.IsBusOff != 0 || (can.State.Flags & CO_MCP2515_EFLG_TXBO) != 0; }

// In bus-off, the controller begins the recovery itself. Configuration mode prevents it. [MCP2515, 6.6]
void begin_bus_off(Can& can) {
  report::count_bus_off(can.State.Report);
  if (can.Recovery == CO_CAN_RECOVERY_BY_APPLICATION) {
    can.State.IsBusOff = 1;
    write_control(can, CO_MCP2515_MODE_CONFIGURATION | CO_MCP2515_ABAT);
  }
}

// Stores the error flags and counts the events that they show.
void store_flags(Can& can, std::uint8_t flags) {
  for (unsigned bit = CO_MCP2515_EFLG_RX0OVR; bit <= CO_MCP2515_EFLG_RX1OVR; bit <<= 1) {
    if ((flags & bit) != 0) {
      report::count_overflow(can.State.Report);
    }
  }
  if ((flags & overflows) != 0) {
    clear_bits(can, CO_MCP2515_EFLG, flags & overflows);
  }
  const bool was_bus_off = is_bus_off(can);
  report::store(can.State.Flags, static_cast<std::uint8_t>(flags & ~overflows));
  if (!was_bus_off && is_bus_off(can)) {
    begin_bus_off(can);
  }
}

// Acknowledges the error interrupt, which the data sheet allows to persist while a flag is set: it is disabled then,
// and Read reads the flags. [MCP2515, 7.7]
void acknowledge_error(Can& can) {
  const std::uint8_t before = can.State.Flags;
  clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
  const TwoRegisters now = read_two(can, CO_MCP2515_CANINTF);
  store_flags(can, now.second);
  if ((now.first & CO_MCP2515_INT_ERR) != 0 && can.State.Flags != 0 && can.State.Flags == before) {
    write(can, CO_MCP2515_CANINTE, all_interrupts & ~CO_MCP2515_INT_ERR);
    can.State.IsErrorMasked = 1;
  }
}

void unmask_error(Can& can) {
  if (can.State.IsErrorMasked != 0 && can.State.Flags == 0) {
    clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
    write(can, CO_MCP2515_CANINTE, all_interrupts);
    can.State.IsErrorMasked = 0;
  }
}

// Does what the flags of the controller require, at most one round. Returns false if there is nothing to do.
bool service_once(Can& can) {
  const TwoRegisters flags = read_two(can, CO_MCP2515_CANINTF);
  if (flags.first == no_answer) {
    return false;
  }
  const unsigned enabled = can.State.IsErrorMasked != 0 ? all_interrupts & ~CO_MCP2515_INT_ERR : all_interrupts;
  store_flags(can, flags.second);
  unmask_error(can);
  receive(can, flags.first);
  if ((flags.first & transmit_interrupts) != 0) {
    request_waiting(can);
  }
  if ((flags.first & enabled & CO_MCP2515_INT_ERR) != 0) {
    acknowledge_error(can);
  }
  return (flags.first & enabled) != 0;
}

bool has_interrupt(const Can& can) { return can.Spi->HasInterrupt == nullptr || can.Spi->HasInterrupt(can.SpiCtx); }

// Does the work of the interrupt, until INT is high. What is left after some rounds is done by Read.
void service(Can& can) {
  if (can.State.Rate == nullptr) {
    return;
  }
  bool is_unfinished = true;
  for (unsigned n = 0; n < service_rounds && is_unfinished; ++n) {
    is_unfinished = service_once(can) && has_interrupt(can);
  }
  can.State.IsUnfinished = is_unfinished ? 1 : 0;
}

// Joining and leaving the bus -----------------------------------------------------------------------------------------

const CO_CAN_MCP2515_RATE* find_rate(const Can& can, std::uint32_t baud) {
  for (unsigned n = 0; n < can.RateNum; ++n) {
    if (can.Rates[n].Baud == baud) {
      return &can.Rates[n];
    }
  }
  return nullptr;
}

void leave_bus(Can& can) {
  enter_configuration(can);
  write(can, CO_MCP2515_CANINTE, 0);
  can.State.Rate = nullptr;
  transmit::forget(can.State.Transmit);
  report::store(can.State.IsMissed, std::uint8_t{0});
  can.State.IsUnfinished = 0;
}

// Empties receive buffers and queue. SPI is held, so no interrupt stores a frame meanwhile.
void discard_received(Can& can) {
  clear_bits(can, CO_MCP2515_CANINTF, receive_interrupts | CO_MCP2515_INT_ERR);
  clear_bits(can, CO_MCP2515_EFLG, overflows);
  static_cast<void>(CORingInit(&can.State.Received, can.Frames, can.FrameNum));
  report::restart(can.State.Report);
}

void join_bus(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  leave_bus(can);
  write(can, CO_MCP2515_CANINTF, 0);
  discard_received(can);
  can.State.Flags = 0;
  can.State.IsBusOff = 0;
  if (write_configuration(can, rate)) {
    can.State.Rate = &rate;
    leave_configuration(can);
  }
}

// Writes the filters on the bus, between two frames of this node.
void change_filters(Can& can) {
  service(can);
  if (is_bus_off(can)) {
    can.State.NeedsFilters = 1;
    return;
  }
  enter_configuration(can);
  static_cast<void>(write_configuration(can, *can.State.Rate));
  leave_configuration(can);
  request_waiting(can);
}

// Reporting -----------------------------------------------------------------------------------------------------------

State state_of(const Can& can) {
  if (is_bus_off(can)) {
    return State::bus_off;
  }
  const bool is_passive = (can.State.Flags & (CO_MCP2515_EFLG_TXEP | CO_MCP2515_EFLG_RXEP)) != 0;
  return is_passive ? State::passive : State::active;
}

std::uint32_t lost_frames(const Can& can) {
  return report::load(can.State.Report.Overflows) + CORingLost(&can.State.Received);
}

// Fills an error frame with the changes since the last report. Returns false if there are none. The error counters are
// read only if there is something to report.
bool report_events(Can& can, CO_IF_FRM& frame) {
  CO_CAN_REPORT& reported = can.State.Report;
  const State now = state_of(can);
  const bool is_quiet = static_cast<std::uint8_t>(now) == reported.Reported &&
                        lost_frames(can) == reported.ReportedLost &&
                        report::load(reported.BusOffs) == reported.SeenBusOffs;
  if (is_quiet) {
    return false;
  }
  const CO_CAN_ERROR_COUNTERS errors = COCanMcp2515Errors(&can);
  return report::take(reported, {report::observed(reported, now), errors, lost_frames(can)}, frame);
}

// Returns whether Read has to use SPI: for events without interrupt, or if the interrupt is not used.
bool needs_service(const Can& can) { return can.State.IsUnfinished != 0 || can.State.Flags != 0 || has_interrupt(can); }

bool needs_requests(const Can& can) {
  const CO_MCP2515_TRANSMIT& box = can.State.Transmit;
  return (box.Aborting | box.Dropped | box.DisplacedNum | can.State.IsAborting) != 0;
}

// Does the work of the loop.
void update(Can& can) {
  if (needs_service(can)) {
    const Exclusive exclusive(can);
    service(can);
  }
  if (needs_requests(can)) {
    const Exclusive exclusive(can);
    request_waiting(can);
  }
  if (can.State.NeedsFilters != 0 && !is_bus_off(can)) {
    const Exclusive exclusive(can);
    change_filters(can);
  }
}

// The driver ----------------------------------------------------------------------------------------------------------

void add_to_bus(Can& can) {
  CO_MCP2515_BUS& bus = bus_of(can);
  for (const Can* one = bus.First; one != nullptr; one = one->State.Next) {
    if (one == &can) {
      return;
    }
  }
  can.State.Next = bus.First;
  bus.First = &can;
}

void init(void* ctx) {
  Can& can = controller(ctx);
  const Exclusive exclusive(can);
  add_to_bus(can);
  leave_bus(can);
  command(can, CO_MCP2515_RESET);
  static_cast<void>(await_configuration(can));
  write_control(can, CO_MCP2515_MODE_CONFIGURATION);
  discard_received(can);
  store_filters(can, open_filters());
}

void enable(void* ctx, std::uint32_t baud) {
  Can& can = controller(ctx);
  const CO_CAN_MCP2515_RATE* const rate = find_rate(can, baud);
  can.State.Report.Reported = static_cast<std::uint8_t>(State::active);
  const Exclusive exclusive(can);
  if (rate == nullptr) {
    leave_bus(can);
    return;
  }
  join_bus(can, *rate);
}

std::int16_t read_driver(void* ctx, CO_IF_FRM* frm) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return 0;
  }
  update(can);
  return report_events(can, *frm) || CORingGet(&can.State.Received, frm) ? one_frame : std::int16_t{0};
}

std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return -1;
  }
  const Exclusive exclusive(can);
  if ((can.State.Flags & CO_MCP2515_EFLG_TXBO) != 0) {
    service(can);
  }
  if (is_bus_off(can)) {
    return -1;
  }
  Buffers buffers(can);
  const bool is_accepted = transmit::accept(can.State.Transmit, buffers, *frm);
  if (can.State.Transmit.DisplacedNum != 0) {
    request_waiting(can);
  }
  return is_accepted ? one_frame : std::int16_t{0};
}

void reset(void* ctx) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return;
  }
  const Exclusive exclusive(can);
  if (can.State.IsBusOff != 0) {
    join_bus(can, *can.State.Rate);
    return;
  }
  CO_MCP2515_TRANSMIT& box = can.State.Transmit;
  Buffers buffers(can);
  box.DisplacedNum = 0;
  box.Dropped = box.Used;
  if (box.Used != 0) {
    buffers.begin_abort();
  }
  discard_received(can);
  transmit::finish(box, buffers);
}

void close(void* ctx) {
  Can& can = controller(ctx);
  const Exclusive exclusive(can);
  leave_bus(can);
}

void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
  Can& can = controller(ctx);
  const Filters present = filters(can);
  if (can.State.Rate != nullptr && !is_open(present) && all_pass(present, ids, num)) {
    return;
  }
  store_filters(can, filters_of(ids, num));
  if (can.State.Rate != nullptr) {
    const Exclusive exclusive(can);
    change_filters(can);
  }
}

}  // namespace
}  // namespace co::mcp2515

using namespace co::mcp2515;

const CO_IF_CAN_DRV_EX Mcp2515CanDriver = {init, enable, read_driver, send, reset, close, filter, CONodeCanReport};

extern "C" {

void COCanMcp2515Interrupt(CO_CAN_MCP2515* can) {
  ASSERT_PTR(can);
  CO_MCP2515_BUS& bus = bus_of(*can);
  co::report::store(can->State.IsMissed, std::uint8_t{1});
  hold(bus);
  release(bus);
}

void COCanMcp2515Hold(CO_MCP2515_BUS* bus) {
  ASSERT_PTR(bus);
  hold(*bus);
}

void COCanMcp2515Release(CO_MCP2515_BUS* bus) {
  ASSERT_PTR(bus);
  release(*bus);
}

bool COCanMcp2515HasFrames(const CO_CAN_MCP2515* can) {
  return can != nullptr && CORingCount(&can->State.Received) != 0;
}

uint32_t COCanMcp2515Lost(const CO_CAN_MCP2515* can) { return can == nullptr ? 0 : lost_frames(*can); }

CO_CAN_ERROR_COUNTERS COCanMcp2515Errors(CO_CAN_MCP2515* can) {
  if (can == nullptr) {
    return {};
  }
  const Exclusive exclusive(*can);
  return read_errors(*can);
}

}  // extern "C"
