// SPDX-License-Identifier: Apache-2.0
#include "node/parts.hpp"

#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "hal/port.hpp"

namespace co {
namespace parts {
namespace {

// The parts that receive frames, as routes number them.
struct Receiver {
  uint8_t allowed;
  uint16_t routes;
  Part::Handler on_frame;
  Part::Handler on_remote;
};
struct Receivers {
  Receiver row[routes::receivers];
};
constexpr Receivers receivers_of_table() {
  Receivers receivers = {};
  unsigned number = 0;
  for (size_t n = 0; n < row_num; ++n) {
    if (routes::routes_of[n] != 0) {
      const Row& row = rows[n];
      receivers.row[number++] = {row.allowed, routes::routes_of[n], row.part.of_frames, row.part.of_remote_frames};
    }
  }
  return receivers;
}
constexpr Receivers receivers = receivers_of_table();

// Returns the number of senders of all parts.
constexpr uint16_t count_senders() {
  uint16_t all = 0;
  for (const Row& row : rows) {
    all = static_cast<uint16_t>(all + (row.is_present ? row.senders : 0));
  }
  return all;
}
constexpr uint16_t senders = count_senders();
static_assert(senders <= UINT8_MAX, "CO_NODE.Transmit.Next");

// Continues the sender with this number. Returns whether it has sent frames.
template <size_t row = 0>
bool continue_sender(CO_NODE& node, uint16_t sender) {
  constexpr uint16_t own = rows[row].is_present ? rows[row].senders : 0;
  if constexpr (own != 0) {
    if (sender < own) {
      constexpr auto function = rows[row].part.of_free;
      return function(node, sender);
    }
  }
  if constexpr (row + 1 < row_num) {
    return continue_sender<row + 1>(node, static_cast<uint16_t>(sender - own));
  }
  return false;
}

}  // namespace

// Continues the senders in round-robin order (index: CO_NODE.Transmit.Next), each with as many frames as the controller
// accepts. The sender that is refused first continues first the next time.
void on_free(CO_NODE& node) {
  unsigned idle = 0;
  CO_ASSERT(senders == 0 || node.Transmit.Next < senders);
  node.Transmit.Paused = 0;
  while (idle < senders && node.Transmit.Paused == 0) {
    const bool sent = continue_sender(node, node.Transmit.Next);
    if (sent || node.Transmit.Paused == 0) {
      node.Transmit.Next = static_cast<uint8_t>(node.Transmit.Next + 1U < senders ? node.Transmit.Next + 1U : 0);
    }
    idle = sent ? 0 : idle + 1;
  }
}

#if CO_ROUTES_SORTED
uint8_t permission_of(uint16_t owner) { return receivers.row[routes::receiver_of(owner)].allowed; }

namespace {

// Calls the parts in the order of the routes, which each part may change.
[[gnu::noinline]] bool dispatch_shared(CO_NODE& node, const CO_IF_FRM& frame, unsigned slot) {
  bool claimed = false;
  bool processed = false;
  const uint32_t id = node.Routes.Id[slot];
  do {
    const uint16_t owner = node.Routes.Owner[slot];
    const bool alone = !routes::is_at(node, slot + 1, id);
    CO_ASSERT(routes::receiver_of(owner) < routes::receivers);
    const Receiver& receiver = receivers.row[routes::receiver_of(owner)];
    if (event::is_allowed(node, receiver.allowed)) {
      const auto process = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? receiver.on_remote : receiver.on_frame;
      claimed = true;
      processed |= process(node, frame, routes::number_of(owner));
    }
    slot = alone ? routes::nowhere : routes::next(node, slot, id, owner);
  } while (slot != routes::nowhere);
  if (claimed && !processed) {
    count(node.Count.Malformed);
  }
  return claimed;
}

}  // namespace

// Calls the only owner of the identifier without a loop: nearly all identifiers have one owner.
bool dispatch(CO_NODE& node, const CO_IF_FRM& frame, unsigned slot) {
  CO_ASSERT(slot < node.Routes.Start[CO_ROUTE_CLASS_N]);
  if (USE_FAST_PATHS == 0 || routes::is_at(node, slot + 1, node.Routes.Id[slot])) {
    return dispatch_shared(node, frame, slot);
  }
  const uint16_t owner = node.Routes.Owner[slot];
  CO_ASSERT(routes::receiver_of(owner) < routes::receivers);
  const Receiver& receiver = receivers.row[routes::receiver_of(owner)];
  if (!event::is_allowed(node, receiver.allowed)) {
    return false;
  }
  const auto process = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? receiver.on_remote : receiver.on_frame;
  if (!process(node, frame, routes::number_of(owner))) {
    count(node.Count.Malformed);
  }
  return true;
}
#else
// Calls each part that consumes the identifier. The part of a position is found by counting routes.
bool dispatch(CO_NODE& node, const CO_IF_FRM& frame) {
  const uint32_t id = frame.Identifier & ~CO_IF_FRM_RTR;
  bool claimed = false;
  bool processed = false;
  for (unsigned slot = 0; (slot = routes::find(node, id, slot)) != CO_ROUTE_N; ++slot) {
    const Receiver* receiver = receivers.row;
    unsigned number = slot;
    for (; number >= receiver->routes; ++receiver) {
      number -= receiver->routes;
    }
    if (event::is_allowed(node, receiver->allowed)) {
      const auto process = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? receiver->on_remote : receiver->on_frame;
      claimed = true;
      processed |= process(node, frame, static_cast<uint16_t>(number));
    }
  }
  if (claimed && !processed) {
    count(node.Count.Malformed);
  }
  return claimed;
}
#endif

}  // namespace parts

void event::change_fault(CO_NODE& node, Fault fault, Change change, uint32_t detail) {
  parts::run<&Part::of_change_fault>(node, fault, change, detail);
}

void event::report_can(CO_NODE& node, CO_CAN_EVENT what) {
  if (what == CO_CAN_BUS_OFF) {
    parts::run<&Part::of_bus_off>(node);
  }
  parts::run<&Part::of_can>(node, what);
}

void event::sync(CO_NODE& node, uint8_t counter) {
  parts::run<&Part::of_sync>(node, counter);
  parts::run<&Part::of_synced>(node);
}

void event::end_sync_window(CO_NODE& node) { parts::run<&Part::of_window>(node); }

void event::change_node_id(CO_NODE& node, uint8_t id) {
  node.NodeId = id;
  parts::run<&Part::of_node_id>(node, id);
}

void event::set_bit_rate(CO_NODE& node, uint32_t rate) {
  node.Baudrate = rate;
  port::can_close(node);
  port::can_init(node);
  routes::publish(node);
  port::can_enable(node, rate);
}

void event::change_lss(CO_NODE& node) { parts::run<&Part::of_lss_changed>(node); }

void event::lose_communication(CO_NODE& node) { error_behaviour::lose_communication(node); }

CO_MODE event::mode_for_switch(CO_NODE& node) { return error_behaviour::mode_for_switch(node); }

void event::change_object(CO_NODE& node, const CO_OBJ& obj) { parts::run<&Part::of_object_changed>(node, obj); }

event::Outlet event::find_outlet(CO_NODE& node, const CO_OBJ& obj) {
  return parts::ask<&Part::of_outlet>(Outlet::none, node, obj);
}

}  // namespace co
