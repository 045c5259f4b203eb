// SPDX-License-Identifier: Apache-2.0
// Last error of a node, and the object that it concerns.
#pragma once

#include "co_core.h"

namespace co::error {

// Sets the node's error and the key of the object that it concerns (flags are ignored, 0: no object). CO_ERR_NONE
// changes nothing.
void report(CO_NODE& node, CO_ERR err, uint32_t key = 0);

}  // namespace co::error
