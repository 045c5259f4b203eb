// SPDX-License-Identifier: Apache-2.0
#include "storage/budget.hpp"

#include "base/timer.hpp"
#include "co_assert.h"

#if USE_PARA && CO_PARA_BUDGET > 0

namespace co::budget {
namespace {

constexpr uint32_t refill_time = 60;  // s

void refill(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  --node.Storage.Used;
  if (node.Storage.Used == 0) {
    stop(node);
  }
}

// Starts the timer that refills the budget: each minute, or at the end of the timer's range if that is shorter.
void start(CO_NODE& node) {
  constexpr uint32_t seconds = 1;
  const uint32_t ticks = tmr::ticks(node, refill_time, seconds);
  tmr::start(node, node.Storage.BudgetTmr, 0, ticks != 0 ? ticks : UINT32_MAX, refill, &node);
}

}  // namespace

bool take_store(CO_NODE& node) {
  CO_ASSERT(node.Storage.Used <= CO_PARA_BUDGET);
  if (node.Storage.Cause != bus) {
    return true;
  }
  if (is_empty(node)) {
    return false;
  }
  if (node.Storage.Used == 0) {
    start(node);
  }
  ++node.Storage.Used;
  node.Storage.Cause = bus_counted;
  return true;
}

void stop(CO_NODE& node) { tmr::stop(node, node.Storage.BudgetTmr); }

}  // namespace co::budget

#endif
