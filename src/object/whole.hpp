// SPDX-License-Identifier: Apache-2.0
// An object passes as a whole, in a PDO.
#pragma once

#include "co_obj.h"

namespace co::obj {

// Runs a Read or Write function of the object's type, of a stream at its beginning. Whoever is in the middle of that,
// or of another extended one, with COObj…Cont() finds the position where it was.
[[nodiscard]] CO_ERR pass_whole(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes);

}  // namespace co::obj
