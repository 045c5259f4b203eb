// SPDX-License-Identifier: Apache-2.0
#include "base/routes.hpp"

#include "co_assert.h"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"

#if CO_ROUTES_SORTED

namespace co::routes {
namespace {

constexpr uint8_t end = CO_ROUTE_CLASS_N;

// Adds by to the positions of the first routes of all function codes behind that of the identifier.
void shift_starts(CO_ROUTES& routes, uint32_t identifier, int by) {
  for (unsigned n = class_of(identifier) + 1U; n <= end; ++n) {
    routes.Start[n] = static_cast<CO_ROUTE_NUM>(routes.Start[n] + by);
  }
}

// Returns whether the route at this position follows the route of identifier and owner.
bool is_behind(const CO_ROUTES& routes, unsigned place, uint32_t identifier, uint16_t owner) {
  return routes.Id[place] > identifier || (routes.Id[place] == identifier && routes.Owner[place] > owner);
}

// Returns the position behind the routes of a function code that begin at a position and are in their order.
[[maybe_unused]] unsigned end_of_class(const CO_ROUTES& routes, unsigned place, unsigned function_code) {
  while (routes.Id[place] != no_identifier && class_of(routes.Id[place]) == function_code &&
         (place == 0 || is_behind(routes, place, routes.Id[place - 1], routes.Owner[place - 1]))) {
    ++place;
  }
  return place;
}

// Returns whether the routes are in their order, end with the mark, and Start has the first route of each function
// code. For assertions.
[[maybe_unused]] bool is_consistent(const CO_ROUTES& routes) {
  unsigned place = 0;
  for (unsigned n = 0; n < end; ++n) {
    if (routes.Start[n] != place) {
      return false;
    }
    place = end_of_class(routes, place, n);
  }
  return routes.Start[end] == place && routes.Id[place] == no_identifier;
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
  unsigned place = routes.Start[end];
  routes.Id[place + 1] = no_identifier;
  for (; place > 0 && is_behind(routes, place - 1, identifier, owner); --place) {
    move(routes, place, place - 1);
  }
  routes.Id[place] = identifier;
  routes.Owner[place] = owner;
  shift_starts(routes, identifier, +1);
  CO_ASSERT(is_consistent(routes));
}

void remove(CO_NODE& node, uint16_t owner) {
  CO_ROUTES& routes = node.Routes;
  const unsigned num = routes.Start[end];
  unsigned place = 0;
  while (place < num && routes.Owner[place] != owner) {
    ++place;
  }
  if (place == num) {
    return;
  }
  shift_starts(routes, routes.Id[place], -1);
  for (; place + 1 < num; ++place) {
    move(routes, place, place + 1);
  }
  routes.Id[place] = no_identifier;
  CO_ASSERT(is_consistent(routes));
}

void change(CO_NODE& node, uint32_t identifier, uint16_t owner) {
  remove(node, owner);
  if (identifier != wire::no_frame) {
    add(node, identifier, owner);
  }
}

unsigned next(const CO_NODE& node, unsigned place, uint32_t identifier, uint16_t owner) {
  const CO_ROUTES& routes = node.Routes;
  if (USE_FAST_PATHS == 0 || place >= routes.Start[end] || !is_at(node, place, identifier) ||
      routes.Owner[place] != owner) {
    place = 0;
  }
  while (!is_behind(routes, place, identifier, owner)) {  // true for the end mark
    ++place;
  }
  return is_at(node, place, identifier) ? place : nowhere;
}

void publish(const CO_NODE& node) {
  if (port::can_wants_filter(node)) {
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
  if (!port::can_wants_filter(node)) {
    return;
  }
  uint32_t sorted[CO_ROUTE_N];
  uint16_t num = 0;
  for (unsigned place = 0; place < CO_ROUTE_N; ++place) {
    const uint32_t identifier = node.Routes.Id[place];
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
