// SPDX-License-Identifier: Apache-2.0
// Transmission of frames. Frames that the controller does not accept are queued in the order of their priority on the
// bus, frames of the same identifier in the order in which they were sent. No frame overtakes the boot-up message.
// [301:7.3.2.2.1]
#pragma once

#include "co_core.h"

namespace co::transmit {

void init(CO_NODE& node);

// Bits of send_as(): how a frame is queued that the controller does not accept at once.
inline constexpr unsigned replaces = 1;  // replaces a queued frame of the same identifier, except the boot-up message
inline constexpr unsigned of_application = 2;  // leaves some elements of the queue for the node's own frames
inline constexpr unsigned ahead = 4;           // follows the fixed frames only; in a full queue the last frame is lost

// Sends a frame, or queues it. Returns false if the queue is full: the frame is lost and counted.
bool send_as(CO_NODE& node, const CO_IF_FRM& frame, unsigned manner);

// Sends a frame of the node.
bool send(CO_NODE& node, const CO_IF_FRM& frame);

inline bool send_for_application(CO_NODE& node, const CO_IF_FRM& frame) { return send_as(node, frame, of_application); }

// Sends a PDO.
inline bool send_process_data(CO_NODE& node, const CO_IF_FRM& frame) {
  return send_as(node, frame, replaces | of_application);
}

// Sends the boot-up message or an LSS frame: in Initialisation, these are sent before all other frames.
inline void send_ahead(CO_NODE& node, const CO_IF_FRM& frame) { send_as(node, frame, ahead); }

// Sends a frame that reports a state repeatedly.
inline bool send_latest(CO_NODE& node, const CO_IF_FRM& frame) { return send_as(node, frame, replaces); }

// Offers the queued frames to the driver, then returns the frame of an identifier that is still queued; null if there
// is none, or it is the boot-up message.
[[nodiscard]] CO_IF_FRM* find_waiting(CO_NODE& node, uint32_t identifier);

// Sends a frame now or not at all, and at most CO_SDO_BLOCK_PACE frames in a call of CONodeProcess() or COTmrProcess():
// for frames that can be generated again. Returns false if it was not sent: Part::free() is called later.
[[nodiscard]] bool offer(CO_NODE& node, const CO_IF_FRM& frame);

// Returns whether frames are held back only by the limit of offer(): the next call can send them.
[[nodiscard]] inline bool is_paced(const CO_NODE& node) {
  return node.Transmit.Paused != 0 && node.Transmit.Burst == CO_SDO_BLOCK_PACE;
}

// Returns whether send() would lose a frame now.
[[nodiscard]] bool is_full(CO_NODE& node);

// Return, without offering frames to the driver, whether a frame of the identifier is queued, and whether a frame of
// the application could be.
[[nodiscard]] bool is_queued(const CO_NODE& node, uint32_t identifier);
[[nodiscard]] bool has_room_for_application(const CO_NODE& node);

// Drops the queued frames of an identifier that must not be sent any more, except fixed ones, and counts them as
// dropped.
void withdraw(CO_NODE& node, uint32_t identifier);

// For withdraw(): the frames of all identifiers.
inline constexpr uint32_t all_frames = UINT32_MAX - 1;

// Drops all queued frames, and counts them as dropped. keeps_responses: except responses of SDO servers and NMT
// commands, which become fixed: they are sent before all frames that are queued later, the boot-up message included; in
// Initialisation all are kept.
void clear(CO_NODE& node, bool keeps_responses);

[[nodiscard]] inline bool is_waiting(const CO_NODE& node) { return node.TxQueue.Num != 0; }

// Offers the queued frames to the driver.
void flush(CO_NODE& node);

}  // namespace co::transmit
