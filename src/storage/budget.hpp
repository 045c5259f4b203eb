// SPDX-License-Identifier: Apache-2.0
// Budget of stores: limits how often requests of the bus (SDO, and autonomous stores of changed values) write the
// non-volatile memory. The budget is CO_PARA_BUDGET stores; each minute one of them becomes available again. Stores of
// the application are not limited.
#pragma once

#include "co_core.h"

namespace co::budget {

#if USE_PARA && CO_PARA_BUDGET > 0

// Values of CO_NODE.Storage.Cause: cause of the writes to the memory that follow.
enum Cause : uint8_t {
  application,  // the application: its writes are not limited
  bus,          // the bus; nothing was written yet: the first write takes one store from the budget
  bus_counted,  // the bus; the first write has taken a store from the budget: further writes take none
};

// Scope of one command of the bus ("save", "load", …), or of one periodic store of the autonomous groups. It takes at
// most one store from the budget, with its first write, for any number of records.
class Command {
 public:
  explicit Command(CO_NODE& node) : node_(node), outer_(node.Storage.Cause) { node.Storage.Cause = bus; }
  ~Command() { node_.Storage.Cause = outer_; }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

 private:
  CO_NODE& node_;
  uint8_t outer_;
};

// Returns whether no store is available.
[[nodiscard]] inline bool is_empty(const CO_NODE& node) { return node.Storage.Used >= CO_PARA_BUDGET; }

// Takes a store from the budget if the bus causes the write and its command has not taken one yet. Returns whether the
// record may be written: false if the budget is used up.
[[nodiscard]] bool take_store(CO_NODE& node);

// Stops the timer that refills the budget: the budget is full, or the node is stopped.
void stop(CO_NODE& node);

#else

class Command {
 public:
  explicit Command(const CO_NODE&) {}
};

[[nodiscard]] inline bool is_empty(const CO_NODE&) { return false; }
[[nodiscard]] inline bool take_store(const CO_NODE&) { return true; }
inline void stop(const CO_NODE&) {}

#endif

}  // namespace co::budget
