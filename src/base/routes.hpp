// SPDX-License-Identifier: Apache-2.0
// Routes: the parts that receive the frames of an identifier. With CO_ROUTES_SORTED the table is sorted by identifier,
// and the first route of each function code is stored with it, so that an unrelated frame is rejected after one or two
// comparisons. Otherwise each receiver has a fixed slot, and all slots are compared.
#pragma once

#include "co_assert.h"
#include "co_core.h"

namespace co {

// Parts of the stack, in the order of their list (lexican/detail/parts.h).
enum class PartId : uint8_t {
#define CO_NAME(part, instances, routes, senders, permission) part,
  CO_PARTS(CO_NAME)
#undef CO_NAME
      count
};

namespace routes {

// Number of routes of each part; 0 for one that the configuration leaves out.
inline constexpr uint16_t routes_of[] = {
#define CO_ROUTES(part, instances, routes, senders, permission) (instances) != 0 ? (routes) : 0,
    CO_PARTS(CO_ROUTES)
#undef CO_ROUTES
};

// Returns how many parts before this one have routes: the index of this part among the receivers.
constexpr unsigned receivers_before(PartId part) {
  unsigned number = 0;
  for (unsigned n = 0; n < static_cast<unsigned>(part); ++n) {
    number += routes_of[n] != 0 ? 1U : 0U;
  }
  return number;
}
inline constexpr unsigned receivers = receivers_before(PartId::count);
static_assert(receivers <= 16, "CO_ROUTES.Owner has 4 bits for the receiver");

// Returns the number of routes of the parts before this one.
constexpr unsigned routes_before(PartId part) {
  unsigned number = 0;
  for (unsigned n = 0; n < static_cast<unsigned>(part); ++n) {
    number += routes_of[n];
  }
  return number;
}
static_assert(routes_before(PartId::count) == CO_ROUTE_N);

// Returns the owner of a route, an instance (number) of a part: where routes are sorted, the number of its part and its
// own; otherwise the slot of its only route.
template <PartId part>
[[nodiscard]] constexpr uint16_t owner(unsigned number) {
  constexpr unsigned base = CO_ROUTES_SORTED ? receivers_before(part) << 12 : routes_before(part);
  return static_cast<uint16_t>(base + number);
}

void clear(CO_NODE& node);

#if CO_ROUTES_SORTED
// Adds a route. identifier: as in a frame (CO_IF_FRM_EXT included). Routes of the same identifier are adjacent, in the
// order of their owners.
void add(CO_NODE& node, uint32_t identifier, uint16_t owner);

// Removes the route of an owner, if there is one.
void remove(CO_NODE& node, uint16_t owner);

// Replaces the route of an owner. identifier: wire::no_frame to remove it only.
void change(CO_NODE& node, uint32_t identifier, uint16_t owner);

#else
// Returns the slot of the first route of an identifier that is not before from; CO_ROUTE_N if there is none. The
// identifier is first stored behind the last slot, so that the loop needs no bound.
[[nodiscard]] inline unsigned find(CO_NODE& node, uint32_t identifier, unsigned from) {
  uint32_t* const ids = node.Routes.Id;
  ids[CO_ROUTE_N] = identifier;
  while (ids[from] != identifier) {
    ++from;
  }
  return from;
}

// Sets the identifier of an owner. identifier: wire::no_frame for none
inline void change(CO_NODE& node, uint32_t identifier, uint16_t owner) {
  CO_ASSERT(owner < CO_ROUTE_N);
  node.Routes.Id[owner] = identifier;
}
inline void add(CO_NODE& node, uint32_t identifier, uint16_t owner) { change(node, identifier, owner); }
#endif

// Passes the identifiers of all routes to the CAN driver, if it has a Filter function.
void publish(const CO_NODE& node);

#if CO_ROUTES_SORTED
// Returns the function code of an identifier; all 29-bit identifiers have the class 16. Returns 0 where the routes are
// not divided by function code (CO_ROUTE_CLASS_N 1).
[[nodiscard]] constexpr uint8_t class_of(uint32_t identifier) {
  constexpr uint8_t extended_class = 16;
  if (CO_ROUTE_CLASS_N == 1) {
    return 0;
  }
  return (identifier & CO_IF_FRM_EXT) != 0 ? extended_class : static_cast<uint8_t>((identifier >> 7) & 0x0FU);
}

// Position of a route that does not exist.
inline constexpr unsigned nowhere = ~0U;

// Identifier of the end mark behind the last route.
inline constexpr uint32_t no_identifier = ~0U;

// Returns whether the route at this slot has the identifier.
[[nodiscard]] inline bool is_at(const CO_NODE& node, unsigned slot, uint32_t identifier) {
  return node.Routes.Id[slot] == identifier;
}

// Returns the slot of the first route of an identifier, or nowhere.
[[nodiscard]] inline unsigned find(const CO_NODE& node, uint32_t identifier) {
  constexpr unsigned short_search = 4;
  const CO_ROUTES& routes = node.Routes;
  const uint8_t fc = class_of(identifier);
  unsigned first = routes.Start[fc];
  unsigned last = routes.Start[fc + 1];
  while (CO_ROUTE_N > short_search && last - first > short_search) {
    const unsigned middle = (first + last) / 2;
    if (routes.Id[middle] < identifier) {
      first = middle + 1;
    } else {
      last = middle + 1;
    }
  }
  while (routes.Id[first] < identifier) {
    ++first;
  }
  return routes.Id[first] == identifier ? first : nowhere;
}

// Returns the slot of the next route of the identifier behind the route of owner, or nowhere. slot: that
// of this route before its part has processed the frame, which may have changed the routes.
[[nodiscard]] unsigned next(const CO_NODE& node, unsigned slot, uint32_t identifier, uint16_t owner);

[[nodiscard]] constexpr uint8_t receiver_of(uint16_t owner) { return static_cast<uint8_t>(owner >> 12); }
[[nodiscard]] constexpr uint16_t number_of(uint16_t owner) { return owner & 0x0FFFU; }

#endif

}  // namespace routes
}  // namespace co
