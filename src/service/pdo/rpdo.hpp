// SPDX-License-Identifier: Apache-2.0
// Reception of RPDOs, as far as multiplex PDOs share it.
#pragma once

#include "base/callbacks.hpp"
#include "service/pdo/mapping.hpp"

namespace co::pdo {

// Bits of CO_RPDO.Faults.
enum RpdoFault : uint8_t {
  too_short = 0x01,  // pdo_short is raised
  too_long = 0x02,   // pdo_long is raised
  late = 0x04,       // pdo_timeout is raised
  unknown = 0x08,    // multiplex PDO: pdo_unknown is raised, because the frame names no object
};

// Returns whether the bit rate is being switched: RPDOs are ignored then.
[[nodiscard]] inline bool is_switching([[maybe_unused]] const CO_NODE& node) {
  return (USE_LSS != 0 || USE_LSS_MASTER != 0) && node.Transmit.Off != 0;
}

// Returns the number of the PDO from 1 as detail of its faults (255 for all numbers above).
[[nodiscard]] uint8_t detail_of(const CO_RPDO& pdo);

// Raises or resolves the given faults, from too_short to late, so that those in is are raised and the others are not.
// Each change is reported once.
void report(CO_RPDO& pdo, unsigned faults, unsigned is);

// Restarts the deadline and resolves the fault of a missed one: a frame was received, or the deadline has changed.
void restart_deadline(CO_RPDO& pdo);

}  // namespace co::pdo
