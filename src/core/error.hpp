// SPDX-License-Identifier: Apache-2.0
// The last error of a node, and the object that it is about.
#pragma once

#include "co_core.h"

namespace co::error {

// Sets the error and the key of its object; flags of the key do not count, 0: no object. CO_ERR_NONE changes nothing.
void report(CO_NODE& node, CO_ERR err, uint32_t key = 0);

}  // namespace co::error
