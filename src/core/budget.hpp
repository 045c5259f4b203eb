// SPDX-License-Identifier: Apache-2.0
// Limits how often the bus makes the node write its non-volatile memory: CO_PARA_BUDGET stores in a row, one more each
// minute. Stores of the application are not limited.
#pragma once

#include "co_core.h"

namespace co::budget {

#if USE_PARA && CO_PARA_BUDGET > 0

enum Payer : uint8_t {
  application,  // CO_NODE.StorePayer: the write in progress is free
  bus,          // the first write takes a store from the budget
  bus_paid,     // a write has taken it
};

// A command of the bus, or a round of autonomous stores. Its first write takes one store from the budget, however many
// records it writes: no record is written more often than the budget allows.
class Command {
 public:
  explicit Command(CO_NODE& node) : node_(node) { node.StorePayer = bus; }
  ~Command() { node_.StorePayer = application; }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

 private:
  CO_NODE& node_;
};

[[nodiscard]] inline bool is_empty(const CO_NODE& node) { return node.StoresUsed >= CO_PARA_BUDGET; }

// Returns whether a record may be written now.
[[nodiscard]] bool take(CO_NODE& node);

// Stops the timer that refills the budget, when the node is stopped.
void stop(CO_NODE& node);

#else

class Command {
 public:
  explicit Command(const CO_NODE&) {}
};

[[nodiscard]] inline bool is_empty(const CO_NODE&) { return false; }
[[nodiscard]] inline bool take(const CO_NODE&) { return true; }
inline void stop(const CO_NODE&) {}

#endif

}  // namespace co::budget
