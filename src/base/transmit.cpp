// SPDX-License-Identifier: Apache-2.0
#include "base/transmit.hpp"

#include "base/error.hpp"
#include "co_assert.h"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"

namespace co::transmit {
namespace {

// Returns the rank of a frame in the arbitration on the bus, lowest first: an 11-bit identifier precedes the 29-bit
// identifiers with the same base.
int32_t rank(const CO_IF_FRM& frame) {
  const uint32_t id = frame.Identifier & CO_IF_FRM_ID;
  const bool extended = (frame.Identifier & CO_IF_FRM_EXT) != 0;
  return static_cast<int32_t>(extended ? (id << 1) | 1U : id << 19);
}

// Returns whether the invariants of the queue hold. For assertions.
[[maybe_unused]] bool is_consistent(const CO_TX_QUEUE& queue) {
  bool is_ordered = true;
  for (unsigned n = queue.Fixed + 1U; n < queue.Num; ++n) {
    is_ordered = is_ordered && rank(queue.Frame[n - 1]) <= rank(queue.Frame[n]);
  }
  return is_ordered && queue.Fixed <= queue.Num && queue.Num <= queue.Len;
}

// Returns whether the next frame may be sent. In Initialisation only fixed frames are sent: frames from before a reset,
// then the boot-up message. After CONodeStop() nothing is sent.
bool may_send_next(const CO_NODE& node) {
  return node.Transmit.Off == 0 && node.Nmt.Mode > (node.TxQueue.Fixed != 0 ? CO_INVALID : CO_INIT);
}

// Inserts a frame behind those of at most this rank; a negative rank precedes all but the fixed frames.
void insert(CO_TX_QUEUE& queue, const CO_IF_FRM& frame, int32_t rank_of_frame) {
  CO_ASSERT(queue.Num < queue.Len);
  unsigned position = queue.Num++;
  for (; position > queue.Fixed && rank(queue.Frame[position - 1]) > rank_of_frame; --position) {
    queue.Frame[position] = queue.Frame[position - 1];
  }
  queue.Frame[position] = frame;
}

void remove_first(CO_TX_QUEUE& queue) {
  --queue.Num;
  for (unsigned n = 0; n < queue.Num; ++n) {
    queue.Frame[n] = queue.Frame[n + 1];
  }
  queue.Fixed = static_cast<uint16_t>(queue.Fixed == 0 ? 0 : queue.Fixed - 1);
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

// Not inlined: most frames are sent at once.
[[gnu::noinline]] bool enqueue(CO_NODE& node, const CO_IF_FRM& frame, uint16_t limit) {
  if (node.TxQueue.Num >= limit) {
    count(node.Count.Dropped);
    return false;
  }
  insert(node.TxQueue, frame, rank(frame));
  CO_ASSERT(is_consistent(node.TxQueue));
  return true;
}

// Offers a frame to the driver. Returns whether the driver has accepted it: accepted frames are counted, a fault of the
// driver is reported as the node's error.
bool offer_to_driver(CO_NODE& node, const CO_IF_FRM& frame) {
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

// Offers the queued frames to the driver, then this frame if none is left. Returns whether the driver has accepted it.
bool try_now(CO_NODE& node, const CO_IF_FRM& frame) {
  if (is_waiting(node)) {
    flush(node);
  }
  return !is_waiting(node) && may_send_next(node) && offer_to_driver(node, frame);
}

// Returns the elements of the queue that frames of the application may use. The others are reserved for the node's own
// frames: one of each SDO server and client, an EMCY message and a heartbeat, but at most half the queue.
uint16_t limit_for_application(const CO_TX_QUEUE& queue) {
  constexpr uint16_t own = 2 + CO_SSDO_N + (USE_CSDO != 0 ? CO_CSDO_N : 0);
  const auto half = static_cast<uint16_t>(queue.Len / 2);
  return static_cast<uint16_t>(queue.Len - (own < half ? own : half));
}

// Replaces the queued frame of the same identifier. Returns false if there is none.
bool replace(CO_NODE& node, const CO_IF_FRM& frame) {
  if (!is_waiting(node)) {
    return false;
  }
  CO_IF_FRM* const waiting = find_waiting(node, frame.Identifier);
  if (waiting != nullptr) {
    *waiting = frame;
  }
  return waiting != nullptr;
}

// Returns whether an identifier is that of the responses of an SDO server, or of NMT commands to other nodes.
bool survives_reset(const CO_NODE& node, uint32_t identifier) {
  bool is_one = identifier == 0;
  for (const CO_SDO& server : node.Sdo) {
    is_one = is_one || server.TxId == identifier;
  }
  return is_one;
}

// Frames that drop() drops, besides those of one identifier.
constexpr uint32_t all_frames = wire::no_frame - 1;
constexpr uint32_t all_but_responses = wire::no_frame - 2;

bool is_dropped(const CO_NODE& node, uint32_t identifier, uint32_t dropped) {
  return identifier == dropped || dropped == all_frames ||
         (dropped == all_but_responses && !survives_reset(node, identifier));
}

// Drops frames of the queue, from a position on, and counts them as dropped.
void drop(CO_NODE& node, unsigned from, uint32_t dropped) {
  CO_TX_QUEUE& queue = node.TxQueue;
  unsigned kept = from;
  for (unsigned n = from; n < queue.Num; ++n) {
    if (is_dropped(node, queue.Frame[n].Identifier, dropped)) {
      count(node.Count.Dropped);
    } else {
      queue.Frame[kept++] = queue.Frame[n];
    }
  }
  queue.Num = static_cast<uint16_t>(kept);
}

}  // namespace

void init(CO_NODE& node) {
  const CO_NODE_EXT& ext = *node.Ext;
  const bool own = ext.TxQueue == nullptr || ext.TxQueueLen == 0;
  node.TxQueue = {own ? node.TxFrame : ext.TxQueue, own ? static_cast<uint16_t>(CO_TX_QUEUE_N) : ext.TxQueueLen, 0, 0};
}

bool send(CO_NODE& node, const CO_IF_FRM& frame) {
  return try_now(node, frame) || enqueue(node, frame, node.TxQueue.Len);
}

bool send_for_application(CO_NODE& node, const CO_IF_FRM& frame) {
  return try_now(node, frame) || enqueue(node, frame, limit_for_application(node.TxQueue));
}

void send_ahead(CO_NODE& node, const CO_IF_FRM& frame) {
  CO_TX_QUEUE& queue = node.TxQueue;
  flush(node);
  if (queue.Fixed == 0 && node.Transmit.Off == 0 && offer_to_driver(node, frame)) {
    return;
  }
  if (queue.Num == queue.Len) {
    --queue.Num;
    count(node.Count.Dropped);
  }
  queue.Fixed = queue.Fixed < queue.Num ? queue.Fixed : queue.Num;
  constexpr int32_t ahead = -1;
  insert(queue, frame, ahead);
  ++queue.Fixed;
  CO_ASSERT(is_consistent(queue));
}

CO_IF_FRM* find_waiting(CO_NODE& node, uint32_t identifier) {
  flush(node);
  return find(node.TxQueue, node.TxQueue.Fixed, identifier);
}

void send_latest(CO_NODE& node, const CO_IF_FRM& frame) {
  if (!replace(node, frame)) {
    send(node, frame);
  }
}

bool send_process_data(CO_NODE& node, const CO_IF_FRM& frame) {
  return replace(node, frame) || send_for_application(node, frame);
}

bool offer(CO_NODE& node, const CO_IF_FRM& frame) {
  if (node.Transmit.Burst == CO_SDO_BLOCK_PACE || !try_now(node, frame)) {
    node.Transmit.Paused = 1;
    return false;
  }
  ++node.Transmit.Burst;
  return true;
}

void flush(CO_NODE& node) {
  while (is_waiting(node) && may_send_next(node) && offer_to_driver(node, node.TxQueue.Frame[0])) {
    remove_first(node.TxQueue);
  }
  CO_ASSERT(is_consistent(node.TxQueue));
}

bool is_full(CO_NODE& node) {
  flush(node);
  return node.TxQueue.Num == node.TxQueue.Len;
}

bool is_queued(const CO_NODE& node, uint32_t identifier) { return find(node.TxQueue, 0, identifier) != nullptr; }

bool has_room_for_application(const CO_NODE& node) { return node.TxQueue.Num < limit_for_application(node.TxQueue); }

void withdraw(CO_NODE& node, uint32_t identifier) {
  drop(node, node.TxQueue.Fixed, identifier);
  CO_ASSERT(is_consistent(node.TxQueue));
}

void clear(CO_NODE& node) {
  node.TxQueue.Fixed = 0;
  drop(node, 0, all_frames);
}

void drop_behind_responses(CO_NODE& node) { drop(node, node.TxQueue.Fixed, all_frames); }

void keep_responses(CO_NODE& node) {
  if (node.Nmt.Mode == CO_INIT) {  // queued frames of Initialisation follow the boot-up message
    return;
  }
  node.TxQueue.Fixed = 0;
  drop(node, 0, all_but_responses);
  node.TxQueue.Fixed = node.TxQueue.Num;
  CO_ASSERT(is_consistent(node.TxQueue));
}

}  // namespace co::transmit
