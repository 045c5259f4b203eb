// SPDX-License-Identifier: Apache-2.0
#include "base/routes.hpp"

#include "co_assert.h"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"

#if CO_ROUTES_SORTED

namespace co::routes {
namespace {

constexpr uint8_t end = CO_ROUTE_CLASS_N;

// Adds by to the slots of the first routes of all function codes behind that of the identifier.
void shift_starts(CO_ROUTES& routes, uint32_t identifier, int by) {
  for (unsigned n = class_of(identifier) + 1U; n <= end; ++n) {
    routes.Start[n] = static_cast<CO_ROUTE_NUM>(routes.Start[n] + by);
  }
}

// Returns whether the route at this slot follows the route of identifier and owner.
bool is_behind(const CO_ROUTES& routes, unsigned slot, uint32_t identifier, uint16_t owner) {
  return routes.Id[slot] > identifier || (routes.Id[slot] == identifier && routes.Owner[slot] > owner);
}

// Returns the slot behind the routes of a function code that begin at a slot and are in their order.
[[maybe_unused]] unsigned end_of_class(const CO_ROUTES& routes, unsigned slot, unsigned function_code) {
  while (routes.Id[slot] != no_identifier && class_of(routes.Id[slot]) == function_code &&
         (slot == 0 || is_behind(routes, slot, routes.Id[slot - 1], routes.Owner[slot - 1]))) {
    ++slot;
  }
  return slot;
}

// Returns whether the routes are in their order, end with the mark, and Start has the first route of each function
// code. For assertions.
[[maybe_unused]] bool is_consistent(const CO_ROUTES& routes) {
  unsigned slot = 0;
  for (unsigned n = 0; n < end; ++n) {
    if (routes.Start[n] != slot) {
      return false;
    }
    slot = end_of_class(routes, slot, n);
  }
  return routes.Start[end] == slot && routes.Id[slot] == no_identifier;
}

void move(CO_ROUTES& routes, unsigned to, unsigned from) {
  routes.Id[to] = routes.Id[from];
  routes.Owner[to] = routes.Owner[from];
}

}  // namespace

void clear(CO_NODE& node) {
  node.Routes = {};
  node.Routes.Id[0] = no_identifier;
}

void add(CO_NODE& node, uint32_t identifier, uint16_t owner) {
  CO_ROUTES& routes = node.Routes;
  CO_ASSERT(receiver_of(owner) < receivers);
  CO_ASSERT(routes.Start[end] < CO_ROUTE_N);
  unsigned slot = routes.Start[end];
  routes.Id[slot + 1] = no_identifier;
  for (; slot > 0 && is_behind(routes, slot - 1, identifier, owner); --slot) {
    move(routes, slot, slot - 1);
  }
  routes.Id[slot] = identifier;
  routes.Owner[slot] = owner;
  shift_starts(routes, identifier, +1);
  CO_ASSERT(is_consistent(routes));
}

void remove(CO_NODE& node, uint16_t owner) {
  CO_ROUTES& routes = node.Routes;
  const unsigned num = routes.Start[end];
  unsigned slot = 0;
  while (slot < num && routes.Owner[slot] != owner) {
    ++slot;
  }
  if (slot == num) {
    return;
  }
  shift_starts(routes, routes.Id[slot], -1);
  for (; slot + 1 < num; ++slot) {
    move(routes, slot, slot + 1);
  }
  routes.Id[slot] = no_identifier;
  CO_ASSERT(is_consistent(routes));
}

void change(CO_NODE& node, uint32_t identifier, uint16_t owner) {
  remove(node, owner);
  if (identifier != wire::no_frame) {
    add(node, identifier, owner);
  }
}

unsigned next(const CO_NODE& node, unsigned slot, uint32_t identifier, uint16_t owner) {
  const CO_ROUTES& routes = node.Routes;
  if (USE_FAST_PATHS == 0 || slot >= routes.Start[end] || !is_at(node, slot, identifier) ||
      routes.Owner[slot] != owner) {
    slot = 0;
  }
  while (!is_behind(routes, slot, identifier, owner)) {  // true for the end mark
    ++slot;
  }
  return is_at(node, slot, identifier) ? slot : nowhere;
}

void publish(const CO_NODE& node) {
  if (port::can_has_filter(node)) {
    port::can_filter(node, node.Routes.Id, node.Routes.Start[end]);
  }
}

}  // namespace co::routes

#else

namespace co::routes {
void clear(CO_NODE& node) {
  for (uint32_t& id : node.Routes.Id) {
    id = wire::no_frame;
  }
}

// Passes a sorted copy of the identifiers, which is on the CPU's stack.
void publish(const CO_NODE& node) {
  if (!port::can_has_filter(node)) {
    return;
  }
  uint32_t sorted[CO_ROUTE_N];
  uint16_t num = 0;
  for (unsigned slot = 0; slot < CO_ROUTE_N; ++slot) {
    const uint32_t identifier = node.Routes.Id[slot];
    if (identifier != wire::no_frame) {
      uint16_t n = num++;
      for (; n > 0 && sorted[n - 1] > identifier; --n) {
        sorted[n] = sorted[n - 1];
      }
      sorted[n] = identifier;
    }
  }
  port::can_filter(node, sorted, num);
}

}  // namespace co::routes

#endif
