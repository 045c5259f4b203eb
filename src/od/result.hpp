// SPDX-License-Identifier: Apache-2.0
// Results, and the abort codes that they stand for.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

// The result with this abort code; ODR_GENERAL if there is none.
[[nodiscard]] ODR_t result_of(uint32_t abort);

// The same for what a type function of the object has answered, with the code that it may have named.
[[nodiscard]] ODR_t result_of(const CO_NODE& node, const CO_OBJ& obj, CO_ERR err);

}  // namespace co::od
