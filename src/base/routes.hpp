// SPDX-License-Identifier: Apache-2.0
// Routes: the services that receive the frames of an identifier. The table is sorted by identifier; the first route of
// each function code is stored beside it, so that an unrelated frame is found to have no consumer after one or two
// comparisons.
#pragma once

#include "co_core.h"

namespace co::routes {

// Service that owns a route: the services that receive frames, in the order of the table of node/services.cpp.
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
#if USE_MPDO
  mpdo,
#endif
#if CO_RPDO_N > 0
  rpdo,
#endif
#if CO_TPDO_N > 0
  tpdo,
#endif
#if USE_GFC
  gfc,
#endif
#if CO_SRDO_N > 0
  srdo,
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

// Number of instances of each service that receive frames; their numbers are lower.
inline constexpr uint16_t instances[] = {
    1,  // nmt
    CO_SSDO_N,
#if USE_CSDO
    CO_CSDO_N,
#endif
    1,  // error_control
#if CO_HBCONS_N > 0
    CO_HBCONS_N + 1,  // sub-indices
#endif
#if USE_SYNC
    1,
#endif
#if USE_TIME
    1,
#endif
#if USE_MPDO
    CO_RPDO_N > 0 ? CO_RPDO_N : 1,
#endif
#if CO_RPDO_N > 0
    CO_RPDO_N,
#endif
#if CO_TPDO_N > 0
    USE_PDO_RTR != 0 ? CO_TPDO_N : 0,
#endif
#if USE_GFC
    1,
#endif
#if CO_SRDO_N > 0
    2 * CO_SRDO_N,
#endif
#if CO_EMCY_CONS_N > 0
    CO_EMCY_CONS_N + 1,  // node-IDs
#endif
#if USE_LSS
    1,
#endif
#if USE_LSS_MASTER
    1,
#endif
};
static_assert(sizeof instances == sizeof(uint16_t) * static_cast<unsigned>(Service::count));

constexpr uint16_t places_of(Service service) { return instances[static_cast<unsigned>(service)]; }

void clear(CO_NODE& node);

#if CO_ROUTES_SORTED
// Adds a route. identifier: as in a frame (CO_IF_FRM_EXT included). Routes of the same identifier are adjacent, in the
// order of their owners.
void add(CO_NODE& node, uint32_t identifier, Service service, uint16_t number);

// Removes the route of an instance (number) of a service, if there is one.
void remove(CO_NODE& node, Service service, uint16_t number);

// Replaces the route of an instance of a service. identifier: wire::no_frame to remove it only.
void change(CO_NODE& node, uint32_t identifier, Service service, uint16_t number);

#else
// Returns the position of the first route of an identifier that is not before from; CO_ROUTE_PLACES if there is none.
[[nodiscard]] inline unsigned find(CO_NODE& node, uint32_t identifier, unsigned from) {
  uint32_t* const ids = node.Routes.Id;
  ids[CO_ROUTE_PLACES] = identifier;
  while (ids[from] != identifier) {
    ++from;
  }
  return from;
}

// Sets the identifier of an instance (number) of a service. identifier: wire::no_frame for none
void change(CO_NODE& node, uint32_t identifier, Service service, uint16_t number);
inline void add(CO_NODE& node, uint32_t identifier, Service service, uint16_t number) {
  change(node, identifier, service, number);
}
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

// Returns whether the route at this position has the identifier.
[[nodiscard]] inline bool is_at(const CO_NODE& node, unsigned place, uint32_t identifier) {
  return node.Routes.Id[place] == identifier;
}

// Returns the position of the first route of an identifier, or nowhere.
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

// Returns the position of the next route of the identifier behind the route of owner, or nowhere. place: position of
// that route before its service has processed the frame, which may have changed the routes.
[[nodiscard]] unsigned next(const CO_NODE& node, unsigned place, uint32_t identifier, uint16_t owner);

[[nodiscard]] constexpr uint8_t service_of(uint16_t owner) { return static_cast<uint8_t>(owner >> 12); }
[[nodiscard]] constexpr uint16_t number_of(uint16_t owner) { return owner & 0x0FFFU; }

#endif

}  // namespace co::routes
