// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs: each frame contains the multiplexer of its object. [301:7.2.3]
#pragma once

#include "base/part.hpp"

namespace co::mpdo {

// Clears CO_MPDO.Producer. To be called before the PDOs are configured from the dictionary.
void init(CO_NODE& node);

// Sends pending objects of the scanner list when the controller can accept frames. Always returns false: one call sends
// as many as possible, so that another call would send nothing.
[[nodiscard]] bool on_free(CO_NODE& node, uint16_t number);

// Implements COTPdoSendTo() (co_pdo.h).
[[nodiscard]] CO_ERR send_to(CO_NODE& node, uint16_t number, uint8_t node_id, uint32_t key, uint32_t value);

inline constexpr Part part = Part().init(init).free(on_free);

}  // namespace co::mpdo
