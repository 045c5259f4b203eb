// SPDX-License-Identifier: Apache-2.0
// Transmission through three buffers, and reception.
#include "../controller.hpp"
#include "../transmit.hpp"
#include "mcp2515_controller.hpp"

// The controller can abort all buffers only: those that were not chosen need places, too.
template <>
inline constexpr unsigned co::transmit::room_of<CO_MCP2515_TRANSMIT> = CO_CAN_DISPLACED;

namespace co::mcp2515 {
namespace {

constexpr unsigned buffer_reads = 8;
constexpr unsigned header_bytes = 5;  // SIDH, SIDL, EID8, EID0, DLC

// Transmit buffers of a controller, for transmit.hpp. Among the requested ones, the controller sends that with the
// highest priority TXP first, among equal ones that with the highest number. [MCP2515, 3.2]
class Buffers {
 public:
  explicit Buffers(Can& can) : can_(can) {}

  // A buffer without request has been sent if TXnIF is set; otherwise it was aborted.
  transmit::Completed take_completed(unsigned used) {
    if (used == 0 && can_.IsAborting == 0) {
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
    if (can_.IsAborting != 0 && (status & CO_MCP2515_STATUS_PENDING) == 0) {
      request_abort(false);
    }
    return completed;
  }

  // Selects a buffer and its priority, so that the frames are sent in the order of their identifiers. None is returned
  // if the frames in the buffers have neighbouring places in that order.
  unsigned free_mailbox(unsigned used, const CO_IF_FRM& frame) {
    if (can_.IsAborting != 0) {
      return CO_CAN_MAILBOXES;
    }
    int above = -1;
    int below = places;
    for (unsigned n = 0; n < CO_CAN_MAILBOXES; ++n) {
      if ((used & (1U << n)) == 0) {
        continue;
      }
      const int place = can_.Priority[n] * CO_CAN_MAILBOXES + static_cast<int>(n);
      const bool is_before = transmit::rank(can_.Transmit.Frame[n].Identifier) < transmit::rank(frame.Identifier);
      below = is_before && place < below ? place : below;
      above = !is_before && place > above ? place : above;
    }
    return place_between(used, above, below);
  }

  // CS rises at the end of the instruction RTS, which has no other byte. [Errata, 5]
  void request(unsigned n, const CO_IF_FRM& frame) {
    const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
    const unsigned length = transmit::length_of(frame);
    std::uint8_t bytes[3 + header_bytes + transmit::bytes_at_most] = {
        CO_MCP2515_WRITE, static_cast<std::uint8_t>(CO_MCP2515_TXCTRL(n)), can_.Priority[n]};
    put_word(word_of(frame.Identifier), bytes + 3);
    bytes[2 + header_bytes] = static_cast<std::uint8_t>((is_remote ? CO_MCP2515_DLC_RTR : 0) | length);
    for (unsigned i = 0; i < transmit::bytes_at_most; ++i) {
      bytes[3 + header_bytes + i] = frame.Data[i];
    }
    transact(can_, bytes, 3 + header_bytes + (is_remote ? 0 : length));
    static_cast<void>(instruct(can_, CO_MCP2515_RTS(n), 1));
  }

  // The controller aborts all buffers but that on the wire, for which take_completed() has no result yet. The request
  // to abort a single one, TXREQ = 0, would not show whether its frame is on the wire.
  void abort(unsigned /*mailboxes*/) {
    request_abort(true);
    request_abort(false);
    can_.Transmit.Aborting = can_.Transmit.Used;
  }

  void request_abort(bool is_requested) {
    can_.IsAborting = is_requested ? 1 : 0;
    write_control(can_, mode_on_bus(can_) | (is_requested ? CO_MCP2515_ABAT : 0));
  }

  // The controller does not show whether another node is transmitting.
  bool is_delayed(unsigned n) {
    const unsigned control = read(can_, CO_MCP2515_TXCTRL(n));
    return !can_.Loopback && (control & CO_MCP2515_TXCTRL_MLOA) != 0;
  }

 private:
  static constexpr int priorities = 4;
  static constexpr int places = priorities * CO_CAN_MAILBOXES;  // in the order of transmission, the last is the first

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
        can_.Priority[n] = static_cast<std::uint8_t>(place / CO_CAN_MAILBOXES);
      }
    }
    return best;
  }

  Can& can_;
};

CO_IF_FRM frame_of(const std::uint8_t* header) {
  CO_IF_FRM frame{};
  const bool is_extended = (header[1] & CO_MCP2515_SIDL_EXIDE) != 0;
  const std::uint32_t id = (std::uint32_t{header[0]} << 21) | ((header[1] & 0xE0U) << 13) |
                           ((header[1] & 0x03U) << 16) | (std::uint32_t{header[2]} << 8) | header[3];
  const bool is_remote = is_extended ? (header[4] & CO_MCP2515_DLC_RTR) != 0 : (header[1] & CO_MCP2515_SIDL_SRR) != 0;
  frame.Identifier = (is_extended ? id | CO_IF_FRM_EXT : id >> 18) | (is_remote ? CO_IF_FRM_RTR : 0);
  frame.DLC = transmit::length_of(header[4] & CO_MCP2515_DLC_LENGTH);
  return frame;
}

// Moves a frame into the queue. CS that rises frees the buffer.
void take_frame(Can& can, unsigned buffer) {
  std::uint8_t bytes[1 + header_bytes] = {static_cast<std::uint8_t>(CO_MCP2515_READ_RX(buffer))};
  can.Spi->Select(can.SpiCtx, true);
  can.Spi->Transfer(can.SpiCtx, bytes, sizeof bytes);
  CO_IF_FRM frame = frame_of(bytes + 1);
  if (frame.DLC != 0 && (frame.Identifier & CO_IF_FRM_RTR) == 0) {
    can.Spi->Transfer(can.SpiCtx, frame.Data, frame.DLC);
  }
  can.Spi->Select(can.SpiCtx, false);
  static_cast<void>(CORingPut(&can.Received, &frame));
}

}  // namespace

void request_waiting(Can& can) {
  if (can.IsBusOff == 0) {
    Buffers buffers(can);
    transmit::finish(can.Transmit, buffers);
  }
}

bool accept(Can& can, const CO_IF_FRM& frame) {
  Buffers buffers(can);
  const bool is_accepted = transmit::accept(can.Transmit, buffers, frame);
  if (can.Transmit.DisplacedNum != 0) {
    transmit::finish(can.Transmit, buffers);
  }
  return is_accepted;
}

void begin_drop(Can& can) {
  can.Transmit.DisplacedNum = 0;
  can.Transmit.Dropped = can.Transmit.Used;
  if (can.Transmit.Used != 0) {
    Buffers(can).request_abort(true);
  }
}

void await_idle_buffers(Can& can) {
  Buffers buffers(can);
  buffers.request_abort(true);
  for (unsigned n = 0; n < status_reads && can.IsAborting != 0; ++n) {
    transmit::collect(can.Transmit, buffers);
  }
}

// Moves the received frames into the queue. Buffer 1 receives the next frame while buffer 0 is full: if it has one when
// buffer 0 is freed, that frame is older than the next one in buffer 0.
void receive(Can& can, unsigned flags) {
  bool is_second_older = false;
  for (unsigned n = 0; n < buffer_reads && (flags & receive_interrupts) != 0; ++n) {
    const bool has_second = (flags & CO_MCP2515_INT_RX(1)) != 0;
    const bool is_first = (flags & CO_MCP2515_INT_RX(0)) != 0 && !(has_second && is_second_older);
    take_frame(can, is_first ? 0 : 1);
    flags = is_first ? read_status(can) : flags & ~CO_MCP2515_INT_RX(1);
    is_second_older = is_first;
  }
}

}  // namespace co::mcp2515
