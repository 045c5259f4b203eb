// SPDX-License-Identifier: Apache-2.0
// Transmission of frames. Frames that the controller does not accept are queued in the order of their priority on the
// bus, frames of the same identifier in the order in which they were sent. No frame overtakes the boot-up message.
// [301:7.3.2.2.1]
#pragma once

#include "co_core.h"

namespace co::transmit {

void init(CO_NODE& node);

// Sends a frame, or queues it. Returns false if the queue is full: the frame is lost and counted.
bool send(CO_NODE& node, const CO_IF_FRM& frame);

// Like send(), for a frame of the application: reserves some elements of the queue for the node's own frames.
bool send_for_application(CO_NODE& node, const CO_IF_FRM& frame);

// Like send_for_application(), for a PDO: replaces an older frame of the PDO that is still queued.
bool send_process_data(CO_NODE& node, const CO_IF_FRM& frame);

// Sends the boot-up message or an LSS frame: in Initialisation, these are sent before all other frames.
void send_ahead(CO_NODE& node, const CO_IF_FRM& frame);

// Sends a frame that reports a state repeatedly: replaces a queued frame of the same identifier, except the boot-up
// message.
void send_latest(CO_NODE& node, const CO_IF_FRM& frame);

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

// Keeps only the queued responses of SDO servers and NMT commands, and counts the other frames as dropped. The kept
// ones are sent before all frames that are queued later, the boot-up message included. In Initialisation keeps all.
void keep_responses(CO_NODE& node);
// Drops the frames that were queued since, and counts them as dropped.
void drop_behind_responses(CO_NODE& node);

// Drops all queued frames, and counts them as dropped.
void clear(CO_NODE& node);

// Like clear(), for the frames of one identifier that must not be sent any more.
void withdraw(CO_NODE& node, uint32_t identifier);

[[nodiscard]] inline bool is_waiting(const CO_NODE& node) { return node.TxQueue.Num != 0; }

// Offers the queued frames to the driver.
void flush(CO_NODE& node);

}  // namespace co::transmit
