// SPDX-License-Identifier: Apache-2.0
#include "core/routes.hpp"

#include "core/port.hpp"

namespace co::routes {
namespace {

constexpr uint8_t end = 17;

static_assert(CO_ROUTE_N <= UINT8_MAX, "routes are counted in 8 bits");

constexpr uint16_t owner(uint8_t service, uint16_t number) {
  return static_cast<uint16_t>((static_cast<unsigned>(service) << 12) | number);
}

void shift_starts(CO_ROUTES& routes, uint32_t identifier, int by) {
  for (unsigned n = class_of(identifier) + 1U; n <= end; ++n) {
    routes.Start[n] = static_cast<uint8_t>(routes.Start[n] + by);
  }
}

void move(CO_ROUTES& routes, unsigned to, unsigned from) {
  routes.Id[to] = routes.Id[from];
  routes.Owner[to] = routes.Owner[from];
}

}  // namespace

void clear(CO_NODE& node) { node.Routes = {}; }

void add(CO_NODE& node, uint32_t identifier, uint8_t service, uint16_t number) {
  CO_ROUTES& routes = node.Routes;
  unsigned place = routes.Start[end];
  for (; place > 0 && routes.Id[place - 1] > identifier; --place) {
    move(routes, place, place - 1);
  }
  routes.Id[place] = identifier;
  routes.Owner[place] = owner(service, number);
  shift_starts(routes, identifier, +1);
}

void remove(CO_NODE& node, uint8_t service, uint16_t number) {
  CO_ROUTES& routes = node.Routes;
  const unsigned num = routes.Start[end];
  unsigned place = 0;
  while (place < num && routes.Owner[place] != owner(service, number)) {
    ++place;
  }
  if (place == num) {
    return;
  }
  shift_starts(routes, routes.Id[place], -1);
  for (; place + 1 < num; ++place) {
    move(routes, place, place + 1);
  }
}

void publish(const CO_NODE& node) {
  if (port::can_wants_filter(node)) {
    port::can_filter(node, node.Routes.Id, node.Routes.Start[end]);
  }
}

}  // namespace co::routes
