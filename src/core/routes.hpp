// SPDX-License-Identifier: Apache-2.0
// Who gets the frames of an identifier: a table sorted by identifier, with the first route of each function code beside
// it, so that a foreign frame is known after one or two comparisons.
#pragma once

#include "co_core.h"

namespace co::routes {

void clear(CO_NODE& node);

// Adds a route; identifier as in a frame (CO_IF_FRM_EXT included). Routes of equal identifiers lie side by side.
void add(CO_NODE& node, uint32_t identifier, uint8_t service, uint16_t number);

// Removes the route of a service's instance, if there is one.
void remove(CO_NODE& node, uint8_t service, uint16_t number);

// Gives the identifiers to a driver that filters.
void publish(const CO_NODE& node);

// The routes [first, last) that an identifier may be among.
struct Range {
  uint16_t first;
  uint16_t last;
};
[[nodiscard]] Range candidates(const CO_NODE& node, uint32_t identifier);

[[nodiscard]] constexpr uint8_t service_of(uint16_t owner) { return static_cast<uint8_t>(owner >> 12); }
[[nodiscard]] constexpr uint16_t number_of(uint16_t owner) { return owner & 0x0FFFU; }

}  // namespace co::routes
