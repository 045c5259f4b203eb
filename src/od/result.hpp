// SPDX-License-Identifier: Apache-2.0
// Conversion of abort codes and error codes to results.
#pragma once

#include "co_core.h"
#include "co_od.h"

namespace co::od {

// Returns the result with this abort code; ODR_GENERAL if there is none.
[[nodiscard]] ODR_t result_of(uint32_t abort);

// Returns the result for the error code of a type function of the object, or for the abort code that the function has
// set.
[[nodiscard]] ODR_t result_of(const CO_NODE& node, const CO_OBJ& obj, CO_ERR err);

}  // namespace co::od
