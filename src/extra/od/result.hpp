// SPDX-License-Identifier: Apache-2.0
// Conversion of SDO abort codes and error codes to ODR_t, the result type of the OD access interface (co_od.h).
#pragma once

#include "co_core.h"
#include "co_od.h"
#include "wire/abort.hpp"

namespace co::od {

// Returns the result for an SDO abort code; ODR_GENERAL if no result stands for this code.
[[nodiscard]] ODR_t result_of(Abort abort);

// Returns the result for the error code of a type function of the object. An abort code that the function has set by
// COObjTypeUserSDOAbort() has priority over the error code.
[[nodiscard]] ODR_t result_of(const CO_NODE& node, const CO_OBJ& obj, CO_ERR err);

}  // namespace co::od
