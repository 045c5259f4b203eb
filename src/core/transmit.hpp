// SPDX-License-Identifier: Apache-2.0
// Sending. What the controller does not take waits in a queue in the order of the priorities on the bus, frames of one
// identifier in the order in which they were sent. The boot-up message is overtaken by nothing. [301:7.3.2.2.1]
#pragma once

#include "co_core.h"

namespace co::transmit {

void init(CO_NODE& node);

// False: the queue is full, the frame is lost and counted.
bool send(CO_NODE& node, const CO_IF_FRM& frame);

// The same for a frame of the application, which leaves some places in the queue to the node's own.
bool send_for_application(CO_NODE& node, const CO_IF_FRM& frame);

// The same for a PDO; an older one of it that still waits is replaced.
bool send_process_data(CO_NODE& node, const CO_IF_FRM& frame);

// Sends what everything else waits for in Initialisation: the boot-up message, or LSS.
void send_ahead(CO_NODE& node, const CO_IF_FRM& frame);

// Sends the state of something that is sent again and again: a frame of the same identifier that still waits is
// replaced, except the boot-up message.
void send_latest(CO_NODE& node, const CO_IF_FRM& frame);

// The frame of an identifier that still waits after those were offered to the driver; null: there is none, or it is the
// boot-up message.
[[nodiscard]] CO_IF_FRM* find_waiting(CO_NODE& node, uint32_t identifier);

// Sends a frame now or not at all, and no more than CO_SDO_BLOCK_PACE in a call of CONodeProcess(): for those that can
// be made again. False: see Service::on_free.
[[nodiscard]] bool offer(CO_NODE& node, const CO_IF_FRM& frame);

// Does a frame that was offered wait for nothing but the next call?
[[nodiscard]] inline bool is_paced(const CO_NODE& node) { return node.Paused != 0 && node.Burst == CO_SDO_BLOCK_PACE; }

// Would send() lose a frame now?
[[nodiscard]] bool is_full(CO_NODE& node);

// What waits goes out before anything that follows, the boot-up message included.
void fix(CO_NODE& node);

// Throws away what waits; counted as dropped.
void clear(CO_NODE& node);

// The same for the frames of one identifier that may no longer be sent.
void withdraw(CO_NODE& node, uint32_t identifier);

[[nodiscard]] inline bool is_waiting(const CO_NODE& node) { return node.TxQueue.Num != 0; }

// Offers the frames that wait to the driver.
void flush(CO_NODE& node);

}  // namespace co::transmit
