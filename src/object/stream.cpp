// SPDX-License-Identifier: Apache-2.0
#include "object/stream.hpp"

#include "co_domain.h"
#include "co_string.h"
#include "core/dict.hpp"

namespace co::stream {

static_assert(offsetof(CO_OBJ_DOM, Offset) == 0 && offsetof(CO_OBJ_STR, Offset) == 0);
static_assert(offsetof(CO_OBJ_STR_RW, Offset) == 0);

CO_ERR reset(CO_OBJ* obj, CO_NODE_T*, uint32_t position) { return seek(*obj, position); }

CO_ERR init(CO_OBJ* obj, CO_NODE_T* node) {
  const CO_ERR err = dict::check_type(*obj, *node, rules::variable);
  if (err != CO_ERR_NONE) {
    return err;
  }
  return seek(*obj, 0) == CO_ERR_NONE ? CO_ERR_NONE : CO_ERR_TYPE_INIT;
}

}  // namespace co::stream
