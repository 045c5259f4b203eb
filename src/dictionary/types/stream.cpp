// SPDX-License-Identifier: Apache-2.0
#include "dictionary/types/stream.hpp"

#include "co_domain.h"
#include "co_string.h"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"

namespace co::stream {

static_assert(offsetof(CO_OBJ_DOM, Offset) == 0 && offsetof(CO_OBJ_STR, Offset) == 0);
static_assert(offsetof(CO_OBJ_STR_RW, Offset) == 0);

CO_ERR reset(CO_OBJ* obj, CO_NODE_T*, uint32_t position) { return seek(*obj, position); }

namespace {

// Returns whether the object is a stream of this library whose Data is null.
bool is_missing(const CO_OBJ& obj) {
  const CO_OBJ_TYPE* const type = original_type(obj);
  return type != nullptr && type->Reset == reset && uintptr_t{obj.Data} == 0;
}

}  // namespace

Abort check(const CO_NODE& node, uint32_t key, const CO_OBJ* obj, CO_OBJ_TRANSFER transfer) {
  const Abort abort = access::check(node, key, obj, transfer);
  return abort == Abort::none && is_missing(*obj) ? Abort::not_stored : abort;
}

#if !USE_OD  // otherwise a function of src/extra/od
const CO_OBJ_TYPE* original_type(const CO_OBJ& obj) { return obj.Type; }
#endif

CO_ERR init(CO_OBJ* obj, CO_NODE_T* node) {
  if (USE_OD == 0 || node->PassStream == nullptr) {  // extensible streams have a function that calls it
    node->PassStream = obj::pass_stream;
  }
  const CO_ERR err = dict::check_type(*obj, *node, rules::variable);
  if (err != CO_ERR_NONE) {
    return err;
  }
  return seek(*obj, 0) == CO_ERR_NONE ? CO_ERR_NONE : CO_ERR_TYPE_INIT;
}

}  // namespace co::stream
