// SPDX-License-Identifier: Apache-2.0
#include "base/transmit.hpp"

#include "base/error.hpp"
#include "co_assert.h"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"

namespace co::transmit {
namespace {

// Returns the rank of a frame in the arbitration on the bus, lowest first and above 0: an 11-bit identifier precedes
// the 29-bit identifiers with the same base. Not inlined: only queued frames have one.
[[gnu::noinline]] uint32_t rank(const CO_IF_FRM& frame) {
  const uint32_t id = frame.Identifier;
  return (id & CO_IF_FRM_EXT) != 0 ? (id << 3) | 2U : (id << 21) | 1U;
}

// Returns whether the invariants of the queue hold. For assertions.
[[maybe_unused]] bool is_consistent(const CO_TX_QUEUE& queue) {
  bool is_ordered = true;
  for (unsigned n = queue.Fixed + 1U; n < queue.Num; ++n) {
    is_ordered = is_ordered && rank(queue.Frame[n - 1]) <= rank(queue.Frame[n]);
  }
  return is_ordered && queue.Fixed <= queue.Num && queue.Num <= queue.Len;
}

// Offers a frame to the driver, unless it may not be sent: in Initialisation only fixed frames are sent, which are
// frames from before a reset, then the boot-up message; after CONodeStop() nothing is sent. Returns whether the driver
// has accepted it: accepted frames are counted, a fault of the driver is reported as the node's error.
bool offer_to_driver(CO_NODE& node, const CO_IF_FRM& frame, unsigned fixed) {
  if (node.Transmit.Off != 0 || node.Nmt.Mode <= (fixed != 0 ? CO_INVALID : CO_INIT)) {
    return false;
  }
  const int16_t result = port::can_send(node, frame);
  if (result > 0) {
    count(node.Count.Sent);
    return true;
  }
  if (result < 0) {
    error::report(node, CO_ERR_IF_CAN_SEND);
  }
  return false;
}

// Returns the elements of the queue that frames of the application may use. The others are reserved for the node's own
// frames: one of each SDO server and client, an EMCY message and a heartbeat, but at most half the queue.
uint16_t limit_for_application(const CO_TX_QUEUE& queue) {
  constexpr uint16_t own = 2 + CO_SSDO_N + (USE_CSDO != 0 ? CO_CSDO_N : 0);
  const auto half = static_cast<uint16_t>(queue.Len / 2);
  return static_cast<uint16_t>(queue.Len - (own < half ? own : half));
}

// Queues a frame behind those of at most its rank, a frame ahead behind the fixed ones.
bool enqueue(CO_NODE& node, const CO_IF_FRM& frame, unsigned manner) {
  CO_TX_QUEUE& queue = node.TxQueue;
  const unsigned is_ahead = manner & ahead;
  if (queue.Num >= ((manner & of_application) != 0 ? limit_for_application(queue) : queue.Len)) {
    count(node.Count.Dropped);
    if (is_ahead == 0) {
      return false;
    }
    --queue.Num;
  }
  CO_IF_FRM* to = queue.Frame + queue.Num++;
  for (; to > queue.Frame + queue.Fixed && (is_ahead != 0 || rank(to[-1]) > rank(frame)); --to) {
    to[0] = to[-1];
  }
  *to = frame;
  if (is_ahead != 0 && queue.Fixed != queue.Num) {
    ++queue.Fixed;
  }
  CO_ASSERT(is_consistent(queue));
  return true;
}

void remove(CO_NODE& node, unsigned position) {
  CO_TX_QUEUE& queue = node.TxQueue;
  --queue.Num;
  for (CO_IF_FRM *frame = queue.Frame + position, *last = queue.Frame + queue.Num; frame != last; ++frame) {
    frame[0] = frame[1];
  }
}

// Returns the first frame of an identifier, from a position on; null: there is none.
CO_IF_FRM* find(const CO_TX_QUEUE& queue, unsigned from, uint32_t identifier) {
  for (unsigned n = from; n < queue.Num; ++n) {
    if (queue.Frame[n].Identifier == identifier) {
      return &queue.Frame[n];
    }
  }
  return nullptr;
}

// Returns whether an identifier is that of the responses of an SDO server, or of NMT commands to other nodes.
bool survives_reset(const CO_NODE& node, uint32_t identifier) {
  bool is_one = identifier == 0;
  for (const CO_SDO& server : node.Sdo) {
    is_one = is_one || server.TxId == identifier || server.WasTxId == identifier;
  }
  return is_one;
}

// Like all_frames, except the frames that survive a reset.
constexpr uint32_t all_but_responses = wire::no_frame - 2;

bool is_withdrawn(const CO_NODE& node, uint32_t identifier, uint32_t withdrawn) {
  return identifier == withdrawn || withdrawn == all_frames ||
         (withdrawn == all_but_responses && !survives_reset(node, identifier));
}

}  // namespace

void init(CO_NODE& node) {
  const CO_NODE_EXT& ext = *node.Ext;
  const bool own = ext.TxQueue == nullptr || ext.TxQueueLen == 0;
  node.TxQueue = {own ? node.TxFrame : ext.TxQueue, own ? static_cast<uint16_t>(CO_TX_QUEUE_N) : ext.TxQueueLen, 0, 0};
}

bool send(CO_NODE& node, const CO_IF_FRM& frame) { return send_as(node, frame, 0); }

bool send_as(CO_NODE& node, const CO_IF_FRM& frame, unsigned manner) {
  const unsigned is_ahead = manner & ahead;
  bool is_next = true;
  if (is_waiting(node)) {
    CO_IF_FRM* const waiting = find_waiting(node, frame.Identifier);
    if (waiting != nullptr && (manner & replaces) != 0) {
      *waiting = frame;
      return true;
    }
    is_next = (is_ahead != 0 ? node.TxQueue.Fixed : node.TxQueue.Num) == 0;
  }
  return (is_next && offer_to_driver(node, frame, is_ahead)) || enqueue(node, frame, manner);
}

CO_IF_FRM* find_waiting(CO_NODE& node, uint32_t identifier) {
  flush(node);
  return find(node.TxQueue, node.TxQueue.Fixed, identifier);
}

bool offer(CO_NODE& node, const CO_IF_FRM& frame) {
  if (is_waiting(node)) {
    flush(node);
  }
  if (node.Transmit.Burst == CO_SDO_BLOCK_PACE || is_waiting(node) || !offer_to_driver(node, frame, 0)) {
    node.Transmit.Paused = 1;
    return false;
  }
  ++node.Transmit.Burst;
  return true;
}

void flush(CO_NODE& node) {
  CO_TX_QUEUE& queue = node.TxQueue;
  while (queue.Num != 0 && offer_to_driver(node, queue.Frame[0], queue.Fixed)) {
    remove(node, 0);
    if (queue.Fixed != 0) {
      --queue.Fixed;
    }
  }
  CO_ASSERT(is_consistent(queue));
}

bool is_full(CO_NODE& node) {
  flush(node);
  return node.TxQueue.Num == node.TxQueue.Len;
}

bool is_queued(const CO_NODE& node, uint32_t identifier) { return find(node.TxQueue, 0, identifier) != nullptr; }

bool has_room_for_application(const CO_NODE& node) { return node.TxQueue.Num < limit_for_application(node.TxQueue); }

// Begins with the last frame: if all are withdrawn, none is moved.
void withdraw(CO_NODE& node, uint32_t identifier) {
  const CO_TX_QUEUE& queue = node.TxQueue;
  for (unsigned n = queue.Num; n-- > queue.Fixed;) {
    if (is_withdrawn(node, queue.Frame[n].Identifier, identifier)) {
      remove(node, n);
      count(node.Count.Dropped);
    }
  }
}

void clear(CO_NODE& node, bool keeps_responses) {
  if (keeps_responses && node.Nmt.Mode == CO_INIT) {  // queued frames of Initialisation follow the boot-up message
    return;
  }
  node.TxQueue.Fixed = 0;
  withdraw(node, keeps_responses ? all_but_responses : all_frames);
  node.TxQueue.Fixed = node.TxQueue.Num;
  CO_ASSERT(is_consistent(node.TxQueue));
}

}  // namespace co::transmit
