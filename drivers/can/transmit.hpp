// SPDX-License-Identifier: Apache-2.0
/// \file transmit.hpp
/// Transmission by priority through a few mailboxes from which the controller selects the frame with the lowest
/// identifier: three (CO_CAN_TRANSMIT), or a single one, for controllers that can abort its frame.
///
/// A frame is accepted if it keeps the order that the node requires. It waits for at most one frame of lower priority
/// of this node, the one on the wire, unless more than five frames are waiting here:
/// - While no frame waits, any frame is accepted. A second frame is refused: in a mailbox it would delay a third one of
///   higher priority. So frames leave a bus without other traffic in the order of acceptance, one after another.
/// - While another node delays the waiting frame (Controller::is_delayed()), frames of higher priority are accepted and
///   sent before it.
/// - If all mailboxes are used, the waiting frame of lowest priority that is not on the wire is aborted and kept in
///   memory, to send a frame of higher priority. It returns to a mailbox as soon as one is free.
/// - Frames with one identifier keep their order: at most one of them is in the mailboxes.
/// - No frame is accepted while the boot-up message is waiting, because none may precede it. [301:7.3.2.2.1]
///
/// All other frames are refused. The node's queue keeps them, ordered by priority, and offers them again.
///
/// Box is CO_CAN_TRANSMIT, or a structure with the same members and another number of mailboxes (elements of Frame).
/// Controller is a class with these members; mailboxes are numbered from 0 on, a set of them is a bit mask:
///
///     Completed take_completed(unsigned used);  // reads and acknowledges the results of requests and aborts
///     // returns a mailbox for a frame that is requested next; the number of mailboxes: none
///     unsigned free_mailbox(unsigned used, const CO_IF_FRM& frame);
///     void request(unsigned mailbox, const CO_IF_FRM& frame);
///     void abort(unsigned mailboxes);
///     bool is_delayed(unsigned mailbox);  // the frame lost the arbitration, or another node is transmitting
#ifndef CO_DRIVERS_TRANSMIT_HPP_
#define CO_DRIVERS_TRANSMIT_HPP_

#include <cstdint>

#include "co_can_controller.h"

namespace co::transmit {

/// Results of requests; bit n: mailbox n.
struct Completed {
  unsigned done;  ///< the mailbox is free again
  unsigned sent;  ///< the frame was sent
};

/// Length of the data field of classic CAN, bytes.
inline constexpr std::uint8_t bytes_at_most = 8;

/// Returns whether a frame has an identifier of 29 bits. Truncated to 11 bits a longer identifier would be that of
/// another message, at worst an NMT command.
inline bool is_extended(std::uint32_t identifier) {
  constexpr std::uint32_t base_ids = 0x7FF;
  return (identifier & CO_IF_FRM_EXT) != 0 || (identifier & CO_IF_FRM_ID) > base_ids;
}

/// Returns the length in bytes, 0…8, for a DLC, which may be larger.
inline std::uint8_t length_of(std::uint32_t dlc) {
  return dlc < bytes_at_most ? static_cast<std::uint8_t>(dlc) : bytes_at_most;
}

/// Returns the length of a frame in bytes, 0…8.
inline std::uint8_t length_of(const CO_IF_FRM& frame) { return length_of(frame.DLC); }

/// Returns four bytes of data as a word; the first byte is in the lowest bits.
inline std::uint32_t word_at(const std::uint8_t* bytes) {
  return bytes[0] | (std::uint32_t{bytes[1]} << 8) | (std::uint32_t{bytes[2]} << 16) | (std::uint32_t{bytes[3]} << 24);
}

/// Writes a word to four bytes of data.
inline void unpack(std::uint32_t word, std::uint8_t* bytes) {
  for (unsigned n = 0; n < 4; ++n) {
    bytes[n] = static_cast<std::uint8_t>(word >> (8 * n));
  }
}

/// Returns the bits of the arbitration field in the order of transmission: the lower value wins the arbitration.
inline std::uint32_t rank(std::uint32_t identifier) {
  const std::uint32_t id = identifier & CO_IF_FRM_ID;
  const std::uint32_t remote = (identifier & CO_IF_FRM_RTR) != 0 ? 1 : 0;
  if (!is_extended(identifier)) {
    return (id << 21) | (remote << 20);
  }
  return ((id >> 18) << 21) | (3U << 19) | ((id & 0x3FFFF) << 1) | remote;
}

/// \cond internal
template <typename Box>
inline constexpr unsigned mailboxes_of = sizeof(Box::Frame) / sizeof(CO_IF_FRM);
template <typename Box>
inline constexpr unsigned all_of = (1U << mailboxes_of<Box>)-1;
template <typename Box>
inline constexpr unsigned displaced_of = sizeof(Box::Displaced) / sizeof(CO_IF_FRM);
// Displaced frames at most, without those that take_back() adds to a box with a single mailbox.
template <typename Box>
inline constexpr unsigned room_of = mailboxes_of<Box> == 1 ? displaced_of<Box> - 1 : displaced_of<Box>;

inline constexpr unsigned all_mailboxes = all_of<CO_CAN_TRANSMIT>;

// Reads of the status register after an abort request, until the mailbox is free. A frame that is not on the wire is
// aborted within a few clock periods of the controller.
inline constexpr unsigned abort_reads = 8;

inline bool is_boot_up(const CO_IF_FRM& frame) {
  constexpr std::uint32_t error_control = 0x700;
  return (frame.Identifier & ~0x7FU) == error_control && frame.DLC == 1 && frame.Data[0] == 0;
}

inline void set(std::uint8_t& mask, unsigned bits) { mask = static_cast<std::uint8_t>(mask | bits); }
inline void clear(std::uint8_t& mask, unsigned bits) { mask = static_cast<std::uint8_t>(mask & ~bits); }

// Result of comparing a new frame with those that wait.
struct Waiting {
  unsigned number = 0;
  unsigned only = 0;  // mailbox of the only waiting frame
  std::uint32_t lowest = UINT32_MAX;
  bool is_blocked = false;  // a frame waits that the new one must not overtake
};

inline void compare(Waiting& waiting, const CO_IF_FRM& frame, const CO_IF_FRM& queued) {
  ++waiting.number;
  const std::uint32_t order = rank(queued.Identifier);
  waiting.lowest = order < waiting.lowest ? order : waiting.lowest;
  const bool is_same = ((frame.Identifier ^ queued.Identifier) & ~CO_IF_FRM_RTR) == 0;
  waiting.is_blocked = waiting.is_blocked || is_same || is_boot_up(queued);
}

template <typename Box>
Waiting compare_all(const Box& box, const CO_IF_FRM& frame) {
  Waiting waiting;
  for (unsigned n = 0; n < mailboxes_of<Box>; ++n) {
    if ((box.Used & ~box.Dropped & (1U << n)) == 0) {
      continue;
    }
    compare(waiting, frame, box.Frame[n]);
    waiting.only = n;
  }
  for (unsigned n = 0; n < box.DisplacedNum; ++n) {
    compare(waiting, frame, box.Displaced[n]);
  }
  return waiting;
}

// Stores the results of completed requests. A frame that was aborted to free its mailbox is kept.
template <typename Box, typename Controller>
void collect(Box& box, Controller& controller) {
  const Completed now = controller.take_completed(box.Used);
  const unsigned done = now.done & box.Used;
  const unsigned kept = done & ~now.sent & ~box.Dropped;
  for (unsigned n = 0; n < mailboxes_of<Box>; ++n) {
    if ((kept & (1U << n)) != 0 && box.DisplacedNum < displaced_of<Box>) {
      box.Displaced[box.DisplacedNum++] = box.Frame[n];
    }
  }
  clear(box.Used, done);
  clear(box.Dropped, done);
  clear(box.Aborting, done);
}

template <typename Box, typename Controller>
bool fill(Box& box, Controller& controller, const CO_IF_FRM& frame) {
  const unsigned mailbox = controller.free_mailbox(box.Used, frame);
  if (mailbox >= mailboxes_of<Box>) {
    return false;
  }
  box.Frame[mailbox] = frame;
  set(box.Used, 1U << mailbox);
  controller.request(mailbox, box.Frame[mailbox]);
  return true;
}

// Moves displaced frames back to free mailboxes, the one of highest priority first.
template <typename Box, typename Controller>
void restore(Box& box, Controller& controller) {
  while (box.DisplacedNum != 0) {
    unsigned first = 0;
    for (unsigned n = 1; n < box.DisplacedNum; ++n) {
      first = rank(box.Displaced[n].Identifier) < rank(box.Displaced[first].Identifier) ? n : first;
    }
    if (!fill(box, controller, box.Displaced[first])) {
      return;
    }
    box.Displaced[first] = box.Displaced[--box.DisplacedNum];
  }
}

// Returns the mailbox with the frame of lowest priority among those that are not being aborted and whose priority is
// lower than order; the number of mailboxes: none.
template <typename Box>
unsigned mailbox_to_displace(const Box& box, std::uint32_t order) {
  unsigned last = mailboxes_of<Box>;
  for (unsigned n = 0; n < mailboxes_of<Box>; ++n) {
    const bool is_aborted = ((box.Aborting | box.Dropped) & (1U << n)) != 0;
    const std::uint32_t present = rank(box.Frame[n].Identifier);
    if (!is_aborted && present > order) {
      order = present;
      last = n;
    }
  }
  return last;
}

// Returns the number of displaced frames when all aborts have ended without transmission.
template <typename Box>
unsigned displaced_at_most(const Box& box) {
  unsigned number = box.DisplacedNum;
  for (unsigned n = 0; n < mailboxes_of<Box>; ++n) {
    number += (box.Aborting >> n) & 1U;
  }
  return number;
}

// Aborts a frame of lower priority than order in order to use its mailbox. The abort of a frame on the wire takes as
// long as that frame; the next frame is aborted then. Returns false if no mailbox is free afterwards, or if there could
// be more than room displaced frames.
template <typename Box, typename Controller>
bool displace(Box& box, Controller& controller, std::uint32_t order, unsigned room) {
  constexpr unsigned attempts = 2;
  for (unsigned attempt = 0; attempt < attempts && box.Used == all_of<Box>; ++attempt) {
    const unsigned mailbox = mailbox_to_displace(box, order);
    if (mailbox == mailboxes_of<Box> || displaced_at_most(box) >= room) {
      return false;
    }
    set(box.Aborting, 1U << mailbox);
    controller.abort(1U << mailbox);
    for (unsigned n = 0; n < abort_reads && (box.Used & (1U << mailbox)) != 0; ++n) {
      collect(box, controller);
    }
  }
  return box.Used != all_of<Box>;
}

// Requests a frame after others were displaced. A controller that aborts all mailboxes at once has also displaced
// frames of higher priority, which are requested before it.
template <typename Box, typename Controller>
bool fill_in_order(Box& box, Controller& controller, const CO_IF_FRM& frame) {
  bool is_first = true;
  for (unsigned n = 0; n < box.DisplacedNum; ++n) {
    is_first = is_first && rank(frame.Identifier) < rank(box.Displaced[n].Identifier);
  }
  if (is_first || box.DisplacedNum == displaced_of<Box>) {
    return fill(box, controller, frame);
  }
  box.Displaced[box.DisplacedNum++] = frame;
  restore(box, controller);
  return true;
}

// Stores a frame beside displaced ones, one of which would be requested before it when the frame on the wire has been
// sent. For a box with a single mailbox. Returns false if the frame need not be stored, or cannot.
template <typename Box>
bool store_beside(Box& box, const CO_IF_FRM& frame, unsigned room) {
  bool is_needed = false;
  for (unsigned n = 0; n < box.DisplacedNum; ++n) {
    is_needed = is_needed || rank(frame.Identifier) < rank(box.Displaced[n].Identifier);
  }
  if (!is_needed || displaced_at_most(box) >= room) {
    return false;
  }
  box.Displaced[box.DisplacedNum++] = frame;
  return true;
}

// Returns whether a displaced frame has a higher priority than that in the only mailbox.
template <typename Box>
bool is_overtaken(const Box& box) {
  for (unsigned n = 0; n < box.DisplacedNum; ++n) {
    if (rank(box.Displaced[n].Identifier) < rank(box.Frame[0].Identifier)) {
      return box.Used != 0;
    }
  }
  return false;
}
/// \endcond

/// Stores the results of transmissions and refills free mailboxes. Called in the transmit interrupt, and in the loop
/// while that interrupt is disabled.
template <typename Box, typename Controller>
void finish(Box& box, Controller& controller) {
  collect(box, controller);
  restore(box, controller);
}

/// Accepts a frame for transmission, or refuses it (false). Called in the loop while the transmit interrupt is
/// disabled.
template <typename Box, typename Controller>
bool accept(Box& box, Controller& controller, const CO_IF_FRM& frame) {
  finish(box, controller);
  const Waiting waiting = compare_all(box, frame);
  const std::uint32_t order = rank(frame.Identifier);
  if (waiting.is_blocked) {
    return false;
  }
  if (waiting.number == 1 && (order > waiting.lowest || !controller.is_delayed(waiting.only))) {
    return false;
  }
  if (box.Used != all_of<Box>) {
    return fill(box, controller, frame);
  }
  // Half of the places are reserved for frames of higher priority than all that wait.
  const unsigned room = order < waiting.lowest ? room_of<Box> : room_of<Box> / 2;
  if (displace(box, controller, order, room)) {
    return fill_in_order(box, controller, frame);
  }
  return mailboxes_of<Box> == 1 && store_beside(box, frame, room);
}

/// Discards all frames. A frame that is on the wire is completed, but not repeated after an error. Called while the
/// transmit interrupt is disabled.
template <typename Box, typename Controller>
void drop(Box& box, Controller& controller) {
  controller.abort(box.Used);
  box.Dropped = box.Used;
  box.DisplacedNum = 0;
}

/// Takes the frames back from the mailboxes after the controller has discarded its requests. finish() requests them
/// again. For a box with a single mailbox.
template <typename Box>
void take_back(Box& box) {
  for (unsigned n = 0; n < mailboxes_of<Box>; ++n) {
    if ((box.Used & ~box.Dropped & (1U << n)) != 0) {
      box.Displaced[box.DisplacedNum++] = box.Frame[n];
    }
  }
  box.Used = 0;
  box.Dropped = 0;
  box.Aborting = 0;
}

/// Discards all frames, after the controller has discarded its own.
template <typename Box>
void forget(Box& box) {
  box.DisplacedNum = 0;
  box.Used = 0;
  box.Dropped = 0;
  box.Aborting = 0;
}

}  // namespace co::transmit

#endif
