// SPDX-License-Identifier: Apache-2.0
// Global fail-safe command. [EN 50325-5]
#pragma once

#include "base/part.hpp"

namespace co::gfc {

// Reads 1300h and applies it.
void init(CO_NODE& node);

// Processes a GFC. Returns false if it is malformed.
[[nodiscard]] bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number);

inline constexpr Part part = Part().init(init).frames(on_frame);

}  // namespace co::gfc
