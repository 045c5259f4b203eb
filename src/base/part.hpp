// SPDX-License-Identifier: Apache-2.0
// The interface of a part of the stack: its functions for the events of a node. Parts do not call each other, except
// that pdo calls mpdo, which extends it.
#pragma once

#include "base/events.hpp"

namespace co {

// The functions of a part. Each is named by a function of this class, for example Part().init(f).frames(g); a part has
// no function for the events that it does not name.
class Part {
 public:
  using Function = void (*)(CO_NODE& node);
  // Processes a frame of one of its routes. Returns false if the frame is malformed.
  using Handler = bool (*)(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

  static bool refuse(CO_NODE&, const CO_IF_FRM&, uint16_t) { return false; }

// A column of the table: the event, the type of the function, and the function of parts that do not name it.
#define CO_COLUMN(event, type, without)       \
  type of_##event = without;                  \
  constexpr Part event(type function) const { \
    Part part = *this;                        \
    part.of_##event = function;               \
    return part;                              \
  }

  // CONodeInit(), with the node cleared; then with its drivers, before the dictionary is known.
  using TakeOver = void (*)(CO_NODE& node, const CO_NODE_SPEC& spec);
  CO_COLUMN(take_over, TakeOver, nullptr)
  CO_COLUMN(begin, Function, nullptr)

  // Each entry of Initialisation: stored values are loaded, then objects and parts are initialised.
  using Load = void (*)(CO_NODE& node, CO_NMT_RESET type);
  CO_COLUMN(load, Load, nullptr)
  CO_COLUMN(init, Function, nullptr)

  CO_COLUMN(frames, Handler, refuse)
  CO_COLUMN(remote_frames, Handler, refuse)

  // transmit::offer() may succeed now for a sender. Returns whether frames were sent.
  using Sender = bool (*)(CO_NODE& node, uint16_t number);
  CO_COLUMN(free, Sender, nullptr)

  // mode: the NMT state has changed. reset: a reset begins. reset_node: before it, if it is that of the application.
  CO_COLUMN(mode, Function, nullptr)
  CO_COLUMN(reset, Function, nullptr)
  CO_COLUMN(reset_node, Function, nullptr)

  // Returns whether a node that is being started has to wait for a node-ID, and whether it is waiting.
  using Start = bool (*)(CO_NODE& node);
  CO_COLUMN(awaits_node_id, Start, nullptr)
  using Question = bool (*)(const CO_NODE& node);
  CO_COLUMN(is_waiting, Question, nullptr)

  // Sends deferred messages: called if the bit of CO_NODE.Pending is set.
  unsigned pending = 0;
  Function of_deferred = nullptr;
  constexpr Part deferred(unsigned bit, Function function) const {
    Part part = *this;
    part.pending = bit;
    part.of_deferred = function;
    return part;
  }

  // configure: parameters have changed. table: the dictionary was replaced, also that of a stopped node. halt: the
  // same, if the node is not stopped; no function of the application has run since. remap: then, the objects in it are
  // found again.
  CO_COLUMN(configure, Function, nullptr)
  CO_COLUMN(table, Function, nullptr)
  CO_COLUMN(halt, Function, nullptr)
  CO_COLUMN(remap, Function, nullptr)

  // Events of other parts, of the controller and of the application (base/events.hpp).
  using ChangeFault = void (*)(CO_NODE& node, event::Fault fault, event::Change change, uint32_t detail);
  CO_COLUMN(change_fault, ChangeFault, nullptr)
  using Can = void (*)(CO_NODE& node, CO_CAN_EVENT what);
  CO_COLUMN(can, Can, nullptr)
  CO_COLUMN(bus_off, Function, nullptr)
  using Sync = void (*)(CO_NODE& node, uint8_t counter);
  CO_COLUMN(sync, Sync, nullptr)
  CO_COLUMN(synced, Function, nullptr)  // its PDOs were processed
  CO_COLUMN(window, Function, nullptr)
  using NodeId = void (*)(CO_NODE& node, uint8_t id);
  CO_COLUMN(node_id, NodeId, nullptr)
  CO_COLUMN(lss_changed, Function, nullptr)
  using ObjectChanged = CO_ERR (*)(CO_NODE& node, const CO_OBJ& obj);
  CO_COLUMN(object_changed, ObjectChanged, nullptr)
  using Outlet = event::Outlet (*)(CO_NODE& node, const CO_OBJ& obj);
  CO_COLUMN(outlet, Outlet, nullptr)
#undef CO_COLUMN
};

}  // namespace co
