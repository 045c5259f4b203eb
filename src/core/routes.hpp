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

// Function code of an identifier; all 29-bit identifiers have one of their own.
[[nodiscard]] constexpr uint8_t class_of(uint32_t identifier) {
  constexpr uint8_t extended_class = 16;
  return (identifier & CO_IF_FRM_EXT) != 0 ? extended_class : static_cast<uint8_t>((identifier >> 7) & 0x0FU);
}

// The routes [first, last) that an identifier may be among.
struct Range {
  uint16_t first;
  uint16_t last;
};
[[nodiscard]] inline Range candidates(const CO_NODE& node, uint32_t identifier) {
  const uint8_t fc = class_of(identifier);
  return {node.Routes.Start[fc], node.Routes.Start[fc + 1]};
}

[[nodiscard]] constexpr uint8_t service_of(uint16_t owner) { return static_cast<uint8_t>(owner >> 12); }
[[nodiscard]] constexpr uint16_t number_of(uint16_t owner) { return owner & 0x0FFFU; }

}  // namespace co::routes
