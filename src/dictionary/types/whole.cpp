// SPDX-License-Identifier: Apache-2.0
// Access of a PDO to an object as a whole.
#include "dictionary/types/stream.hpp"

#include "co_core.h"
#include "dictionary/obj.hpp"

namespace co::obj {
namespace {

CO_ERR pass_at_beginning(CO_OBJ& obj, CO_NODE& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  const CO_ERR err = seek(obj, node, 0);
  return err != CO_ERR_NONE ? err : function(&obj, &node, data, bytes);
}

}  // namespace

CO_ERR pass_stream(CO_OBJ* source, CO_NODE* owner, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  CO_OBJ& obj = *source;
  CO_NODE& node = *owner;
  const CO_OBJ_TYPE* const type = stream::original_type(obj);
  if (type == nullptr || type->Reset != stream::reset) {
    return pass_at_beginning(obj, node, function, data, bytes);
  }
  const stream::KeptPosition position(obj);
  return pass_at_beginning(obj, node, function, data, bytes);
}

CO_ERR access_whole(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_READ_FUNC function, void* data, uint32_t bytes) {
  if (!is_stream(obj)) {
    return function(&obj, &node, data, bytes);
  }
  return node.PassStream != nullptr ? node.PassStream(&obj, &node, function, data, bytes)
                                    : pass_at_beginning(obj, node, function, data, bytes);
}

}  // namespace co::obj
