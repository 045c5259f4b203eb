// SPDX-License-Identifier: Apache-2.0
#include "co_can_mcp251xfd.h"

#include <cstddef>
#include <cstdint>

#include "../controller.hpp"
#include "../mask_filters.hpp"
#include "../spi.hpp"
#include "../transmit.hpp"
#include "mcp251xfd_registers.hpp"

// The queue sends the lowest identifier first: no frame is displaced for another one.
template <>
inline constexpr unsigned co::transmit::room_of<CO_MCP251XFD_TRANSMIT> = 0;

namespace co::mcp251xfd {
namespace {

using Can = CO_CAN_MCP251XFD;
using report::State;
using spi::Exclusive;
using Words = std::uint32_t[4];

// Readings until a wait ends without success. The frame on the wire has to end before the controller goes off the bus.
constexpr unsigned status_reads = 20000;
constexpr unsigned oscillator_reads = 2000;
constexpr unsigned service_rounds = 8;
constexpr unsigned receive_places = 32;
constexpr unsigned filter_number = 31;  // the last one passes all frames, without filters and while they change
constexpr std::uint32_t no_answer = 0xFFFFFFFF;
constexpr std::uint32_t used_interrupts = interrupt_receive | interrupt_mode | interrupt_event | interrupt_error;

// SPI -----------------------------------------------------------------------------------------------------------------

// Writes words, or replaces them by those that are read.
void access(const Can& can, unsigned command, std::uint32_t* words, std::size_t number) {
  std::uint8_t bytes[2 + sizeof(Words)] = {static_cast<std::uint8_t>(command >> 8), static_cast<std::uint8_t>(command)};
  for (std::size_t n = 0; n < number; ++n) {
    transmit::unpack(words[n], bytes + 2 + 4 * n);
  }
  spi::transact(can, bytes, static_cast<unsigned>(2 + 4 * number));
  for (std::size_t n = 0; n < number; ++n) {
    words[n] = transmit::word_at(bytes + 2 + 4 * n);
  }
}

std::uint32_t read(const Can& can, unsigned address) {
  std::uint32_t word = 0;
  access(can, instruction_read | address, &word, 1);
  return word;
}

void write(const Can& can, unsigned address, std::uint32_t word) { access(can, instruction_write | address, &word, 1); }

void write_byte(const Can& can, unsigned address, unsigned value) {
  const unsigned command = instruction_write | address;
  std::uint8_t bytes[] = {static_cast<std::uint8_t>(command >> 8), static_cast<std::uint8_t>(command),
                          static_cast<std::uint8_t>(value)};
  spi::transact(can, bytes, sizeof bytes);
}

bool await_bits(const Can& can, unsigned address, std::uint32_t bits, std::uint32_t value, unsigned reads) {
  while (reads != 0 && (read(can, address) & bits) != value) {
    --reads;
  }
  return reads != 0;
}

// Selects the mode on the bus.
void request_mode(const Can& can) { write_byte(can, control + 3, can.Loopback ? request_loopback : request_normal); }

// Returns the address of the object to which a register UA points.
unsigned object_at(std::uint32_t offset) { return message_memory + (offset & 0x7FC); }

// Codes a word of namespace identifiers like C1FLTOBJ, and, without bit 30, like the first word of a message.
std::uint32_t object_of(std::uint32_t word) {
  return (word >> 18 & 0x7FF) | (word & 0x3FFFF) << 11 |
         ((word & identifiers::extended_bit) != 0 ? filter_extended : 0);
}

// Transmitting --------------------------------------------------------------------------------------------------------

bool is_in_bus_off(const Can& can) { return can.IsBusOff != 0 || (can.Errors & error_bus_off) != 0; }

// The transmit queue of a controller, for transmit.hpp: SEQ is the number of a mailbox.
class Queue {
 public:
  explicit Queue(Can& can) : can_(can) {}

  // Frames without an event that the controller does not request any more were aborted, or discarded in bus-off. Events
  // are read after the request, so that none remains for a mailbox that is used again.
  transmit::Completed take_completed(unsigned used) {
    if (used == 0) {
      return {};
    }
    read_queue();
    const unsigned sent = take_events();
    if ((queue_[0] & requested) != 0) {
      return {sent, sent};
    }
    if ((used & ~sent) != 0) {
      write_byte(can_, queue_control + 1, byte_reset);
      is_read_ = false;
    }
    return {used, sent};
  }

  // The registers are valid when the controller has left Configuration mode.
  unsigned free_mailbox(unsigned used, const CO_IF_FRM& /*frame*/) {
    if (can_.IsJoining != 0 && (read(can_, control) & control_mode) == control_configuration) {
      return CO_MCP251XFD_QUEUE;
    }
    can_.IsJoining = 0;
    if (!is_read_) {
      read_queue();
    }
    const bool is_ready = (queue_[0] & resetting) == 0 && (queue_[1] & status_ready) != 0;
    unsigned n = 0;
    while (n < CO_MCP251XFD_QUEUE && (used & (1U << n)) != 0) {
      ++n;
    }
    return is_ready && !is_in_bus_off(can_) && can_.Transmit.Dropped == 0 ? n : CO_MCP251XFD_QUEUE;
  }

  void request(unsigned n, const CO_IF_FRM& frame) {
    const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
    const std::uint32_t id = object_of(identifiers::word_of(frame.Identifier));
    const unsigned length = transmit::length_of(frame);
    Words object = {id & ~filter_extended,
                    length | (n << message_sequence) | (is_remote ? message_remote : 0) |
                        ((id & filter_extended) != 0 ? message_extended : 0),
                    transmit::word_at(frame.Data), transmit::word_at(frame.Data + 4)};
    access(can_, instruction_write | object_at(queue_[2]), object, is_remote ? 2 : 2 + (length + 3) / 4);
    write_byte(can_, queue_control + 1, byte_next | byte_request);
    can_.IsDelayed = can_.Transmit.Used == (1U << n) ? 0 : can_.IsDelayed;
    is_read_ = false;
  }

  void abort(unsigned /*mailboxes*/) { write_byte(can_, queue_control + 1, 0); }

  // The controller does not show whether another node is transmitting.
  bool is_delayed(unsigned /*mailbox*/) const { return can_.IsDelayed != 0; }

 private:
  // The flag of a lost arbitration may be cleared when it is read.
  void read_queue() {
    access(can_, instruction_read | queue_control, queue_, 3);
    can_.IsDelayed = (queue_[1] & status_lost_arbitration) != 0 ? 1 : can_.IsDelayed;
    is_read_ = true;
  }

  // Returns the mailboxes whose frames were sent.
  unsigned take_events() {
    unsigned sent = 0;
    for (unsigned n = 0; n < CO_MCP251XFD_QUEUE; ++n) {
      Words event = {};
      access(can_, instruction_read | event_status, event, 2);
      if ((event[0] & status_ready) == 0) {
        break;
      }
      access(can_, instruction_read | object_at(event[1]), event, 2);
      write_byte(can_, event_control + 1, byte_next);
      sent |= 1U << (event[1] >> message_sequence & 0x07);
    }
    return sent;
  }

  Can& can_;
  Words queue_ = {};  // control, status, address of the next object
  bool is_read_ = false;
};

// Stores the results of transmissions, and requests frames that the controller has discarded.
void finish(Can& can) {
  Queue queue(can);
  transmit::finish(can.Transmit, queue);
}

// Receiving -----------------------------------------------------------------------------------------------------------

CO_IF_FRM frame_of(const Words& object) {
  CO_IF_FRM frame{};
  const std::uint32_t base = object[0] & 0x7FF;
  const bool is_extended = (object[1] & message_extended) != 0;
  const bool is_remote = (object[1] & message_remote) != 0;
  frame.Identifier =
      (is_extended ? CO_IF_FRM_EXT | base << 18 | (object[0] >> 11 & 0x3FFFF) : base) | (is_remote ? CO_IF_FRM_RTR : 0);
  frame.DLC = transmit::length_of(object[1] & message_dlc);
  for (unsigned n = 0; n < frame.DLC && !is_remote; ++n) {
    frame.Data[n] = static_cast<std::uint8_t>(object[2 + n / 4] >> (8 * (n % 4)));
  }
  return frame;
}

// Moves the received frames into the queue.
void receive(Can& can) {
  for (unsigned n = 0; n < receive_places; ++n) {
    Words object = {};
    access(can, instruction_read | receive_status, object, 2);
    if ((object[0] & status_overflow) != 0) {
      report::count_overflow(can.Report);
      write_byte(can, receive_status, 0);
    }
    if ((object[0] & status_ready) == 0) {
      return;
    }
    access(can, instruction_read | object_at(object[1]), object, 4);
    write_byte(can, receive_control + 1, byte_next);
    if ((object[1] & message_fd) == 0) {
      const CO_IF_FRM frame = frame_of(object);
      static_cast<void>(CORingPut(&can.Received, &frame));
    }
  }
}

// Interrupt -----------------------------------------------------------------------------------------------------------

// In bus-off, the controller begins the recovery itself. Configuration mode prevents it.
void begin_bus_off(Can& can) {
  report::count_bus_off(can.Report);
  if (can.Recovery == CO_CAN_RECOVERY_BY_APPLICATION) {
    can.IsBusOff = 1;
    write_byte(can, control + 3, request_configuration | request_abort);
  }
}

// Reads the error state. The diagnosis, which shows a bus-off since it was cleared, is read first: a bus-off that
// begins between both readings is then seen in the error state.
void read_errors(Can& can) {
  const bool was_bus_off = is_in_bus_off(can);
  const bool is_diagnosed = (read(can, diagnosis) & diagnosis_bus_off) != 0;
  report::store(can.Errors, static_cast<std::uint8_t>(read(can, errors) >> 16 & (error_passive | error_bus_off)));
  if (!was_bus_off && (is_diagnosed || is_in_bus_off(can))) {
    begin_bus_off(can);
  }
  if ((was_bus_off || is_diagnosed) && !is_in_bus_off(can)) {
    write_byte(can, diagnosis + 2, 0);
    finish(can);
  }
}

// Does what the flags of the controller require, at most one round. Returns false if there is nothing to do.
bool service_once(Can& can) {
  const std::uint32_t flags = read(can, interrupts);
  if (flags == no_answer) {
    return false;
  }
  if ((flags & interrupt_error) != 0) {
    write_byte(can, interrupts + 1, 0);
  }
  if ((flags & interrupt_error) != 0 || can.Errors != 0) {
    read_errors(can);
  }
  if ((flags & interrupt_mode) != 0) {
    write_byte(can, interrupts, 0);
  }
  // The controller has left the bus after an underflow of its message buffers. It keeps its frames.
  if ((flags & interrupt_mode) != 0 && can.IsBusOff == 0) {
    request_mode(can);
  }
  if ((flags & interrupt_receive) != 0) {
    receive(can);
  }
  if ((flags & interrupt_event) != 0) {
    finish(can);
  }
  return (flags & used_interrupts) != 0;
}

// Does the work of the interrupt, until INT is high. Read continues after some rounds.
void service(Can& can) {
  if (can.Rate == nullptr) {
    return;
  }
  bool is_unfinished = true;
  for (unsigned n = 0; n < service_rounds && is_unfinished; ++n) {
    is_unfinished = service_once(can) && spi::has_interrupt(can);
  }
  can.IsUnfinished = is_unfinished ? 1 : 0;
}

// Modes ---------------------------------------------------------------------------------------------------------------

void await_oscillator(const Can& can, std::uint32_t ready) {
  static_cast<void>(await_bits(can, oscillator, ready, ready, oscillator_reads));
}

// Resets the controller, to Configuration mode; all frames pass. Values that are not written are those after a reset:
// transmit queue and events are enabled, failed frames are repeated.
void reset_controller(const Can& can) {
  std::uint8_t reset[2] = {};
  spi::transact(can, reset, sizeof reset);
  await_oscillator(can, oscillator_ready);
  write_byte(can, oscillator, can.Clock);
  await_oscillator(can, oscillator_ready | (can.Clock & oscillator_pll) << pll_to_ready);
  write(can, event_control, objects(CO_MCP251XFD_QUEUE) | not_empty_enable);
  write(can, queue_control, objects(CO_MCP251XFD_QUEUE + 1));  // never full: its address changes with UINC only
  write(can, receive_control, objects(receive_places) | not_empty_enable);
  write_byte(can, filter_control + filter_number, filter_to_fifo1);
}

// Goes off the bus after the frame on the wire. A controller that does not follow is reset.
void enter_configuration(const Can& can) {
  write_byte(can, control + 3, request_configuration | request_abort);
  if (!await_bits(can, control, control_mode, control_configuration, status_reads)) {
    reset_controller(can);
  }
}

struct Port {
  using Can = CO_CAN_MCP251XFD;

  // Reads the error state in bus-off: its end need not cause an interrupt.
  static bool is_bus_off(Can& can) {
    if ((can.Errors & error_bus_off) != 0) {
      const Exclusive exclusive(can);
      service(can);
    }
    return is_in_bus_off(can);
  }

  // Uses SPI only for events without interrupt, or if the interrupt is not used.
  static State poll(Can& can) {
    const Exclusive exclusive(can);
    if (can.IsUnfinished != 0 || can.Errors != 0 || spi::has_interrupt(can)) {
      service(can);
    }
    if ((can.Transmit.Dropped | can.Transmit.DisplacedNum) != 0) {
      finish(can);
    }
    return is_in_bus_off(can) ? State::bus_off : can.Errors != 0 ? State::passive : State::active;
  }

  static CO_CAN_ERROR_COUNTERS errors(Can& can) {
    const Exclusive exclusive(can);
    const std::uint32_t counters = read(can, mcp251xfd::errors);
    return {static_cast<std::uint8_t>(counters >> 8), static_cast<std::uint8_t>(counters)};
  }

  static bool accept(Can& can, const CO_IF_FRM& frame) {
    const Exclusive exclusive(can);
    Queue queue(can);
    return !is_in_bus_off(can) && transmit::accept(can.Transmit, queue, frame);
  }

  // Empties receive FIFO and queue, and forgets a bus-off that has ended. SPI is held, so no interrupt stores a frame
  // meanwhile.
  static void discard_received(Can& can) {
    write_byte(can, receive_control + 1, byte_reset);
    write_byte(can, receive_status, 0);
    write_byte(can, diagnosis + 2, 0);
    static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
    report::restart(can.Report);
  }

  static void discard(Can& can) {
    const Exclusive exclusive(can);
    Queue queue(can);
    transmit::drop(can.Transmit, queue);
    discard_received(can);
  }

  static void leave_bus(Can& can) {
    const Exclusive exclusive(can);
    enter_configuration(can);
    write(can, interrupts, 0);
    can.Rate = nullptr;
    transmit::forget(can.Transmit);
    report::store(can.User.IsMissed, std::uint8_t{0});
    can.IsUnfinished = 0;
    can.Errors = 0;
    can.IsBusOff = 0;
  }

  // An automatic recovery with the same bit rate continues.
  static void join_bus(Can& can, const CO_CAN_MCP251XFD_RATE& rate) {
    if (&rate == can.Rate && can.IsBusOff == 0 && is_in_bus_off(can)) {
      discard(can);
      return;
    }
    const Exclusive exclusive(can);
    leave_bus(can);
    discard_received(can);
    write(can, timing, rate.Timing);
    if (can.DataTiming != 0) {
      write(can, data_timing, can.DataTiming);
    }
    write(can, interrupts, used_interrupts << 16);
    if (read(can, timing) == rate.Timing) {
      can.Rate = &rate;
      can.IsJoining = 1;
      request_mode(can);
    }
  }

  static void init(Can& can) {
    const Exclusive exclusive(can);
    spi::add_to_bus(can, [](void* ctx) { service(*static_cast<Can*>(ctx)); });
    await_oscillator(can, oscillator_ready);
    leave_bus(can);
    reset_controller(can);
    discard_received(can);
  }

  static void filter(Can& can, const std::uint32_t* ids, unsigned num) {
    const Exclusive exclusive(can);
    const auto items = identifiers::items_of<filter_number>(ids, num);
    write_byte(can, filter_control + filter_number, filter_to_fifo1);
    for (unsigned n = 0; n < filter_number; ++n) {
      write_byte(can, filter_control + n, 0);
      if (n < items.number) {
        Words filter = {object_of(items.filter[n].word), object_of(items.filter[n].mask)};
        access(can, instruction_write | (filter_object + 8 * n), filter, 2);
        write_byte(can, filter_control + n, filter_to_fifo1);
      }
    }
    write_byte(can, filter_control + filter_number, 0);
  }
};

using Driver = controller::Driver<Port>;

}  // namespace
}  // namespace co::mcp251xfd

using namespace co;

const CO_IF_CAN_DRV_EX Mcp251xfdCanDriver = mcp251xfd::Driver::table;

extern "C" {

void COCanMcp251xfdInterrupt(CO_CAN_MCP251XFD* can) {
  ASSERT_PTR(can);
  spi::interrupt(*can);
}

void COCanMcp251xfdHold(CO_CAN_SPI_BUS* bus) {
  ASSERT_PTR(bus);
  spi::hold(*bus);
}

void COCanMcp251xfdRelease(CO_CAN_SPI_BUS* bus) {
  ASSERT_PTR(bus);
  spi::release(*bus);
}

bool COCanMcp251xfdHasFrames(const CO_CAN_MCP251XFD* can) { return mcp251xfd::Driver::has_frames(can); }
uint32_t COCanMcp251xfdLost(const CO_CAN_MCP251XFD* can) { return mcp251xfd::Driver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanMcp251xfdErrors(CO_CAN_MCP251XFD* can) {
  return can == nullptr ? CO_CAN_ERROR_COUNTERS{} : mcp251xfd::Port::errors(*can);
}

}  // extern "C"
