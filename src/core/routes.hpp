// SPDX-License-Identifier: Apache-2.0
// Who gets the frames of an identifier: a table sorted by identifier, with the first route of each function code beside
// it, so that a foreign frame is known after one or two comparisons.
#pragma once

#include "co_core.h"

namespace co::routes {

// Whose a route is: the rows of the table of node/services.cpp that get frames, in its order.
enum class Service : uint8_t {
  nmt,
  sdo_server,
#if USE_CSDO
  sdo_client,
#endif
  error_control,
#if CO_HBCONS_N > 0
  heartbeat_consumer,
#endif
#if USE_SYNC
  sync,
#endif
#if USE_TIME
  time,
#endif
#if CO_RPDO_N > 0
  rpdo,
#endif
#if CO_TPDO_N > 0
  tpdo,
#endif
#if CO_EMCY_CONS_N > 0
  emcy_consumer,
#endif
#if USE_LSS
  lss,
#endif
#if USE_LSS_MASTER
  lss_master,
#endif
  count
};

void clear(CO_NODE& node);

// Adds a route; identifier as in a frame (CO_IF_FRM_EXT included). Routes of equal identifiers lie side by side, by
// owner.
void add(CO_NODE& node, uint32_t identifier, Service service, uint16_t number);

// Removes the route of a service's instance, if there is one.
void remove(CO_NODE& node, Service service, uint16_t number);

// Lets the instance have this route alone; wire::no_frame: none.
void change(CO_NODE& node, uint32_t identifier, Service service, uint16_t number);

// Gives the identifiers to a driver that filters.
void publish(const CO_NODE& node);

// Function code of an identifier; all 29-bit identifiers have one of their own. 0 where one search is enough.
[[nodiscard]] constexpr uint8_t class_of(uint32_t identifier) {
  constexpr uint8_t extended_class = 16;
  if (CO_ROUTE_CLASS_N == 1) {
    return 0;
  }
  return (identifier & CO_IF_FRM_EXT) != 0 ? extended_class : static_cast<uint8_t>((identifier >> 7) & 0x0FU);
}

inline constexpr unsigned nowhere = ~0U;

// Stands behind the last route.
inline constexpr uint32_t no_identifier = ~0U;

// Is the route at this place one of the identifier?
[[nodiscard]] inline bool is_at(const CO_NODE& node, unsigned place, uint32_t identifier) {
  return node.Routes.Id[place] == identifier;
}

// The first place of the routes of an identifier, or nowhere.
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

// The place behind the owner at this place, who may have changed the routes while it was served; or nowhere.
[[nodiscard]] unsigned next(const CO_NODE& node, unsigned place, uint32_t identifier, uint16_t owner);

[[nodiscard]] constexpr uint8_t service_of(uint16_t owner) { return static_cast<uint8_t>(owner >> 12); }
[[nodiscard]] constexpr uint16_t number_of(uint16_t owner) { return owner & 0x0FFFU; }

}  // namespace co::routes
