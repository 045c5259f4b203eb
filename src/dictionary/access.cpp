// SPDX-License-Identifier: Apache-2.0
#include "dictionary/access.hpp"

#include "base/error.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"

namespace co::access {
namespace {

// Returns the abort code for an access that the rights or the type of the object do not permit.
Abort refusal(const CO_OBJ& obj, CO_OBJ_TRANSFER transfer) {
  if ((obj.Key & CO_OBJ_____RW) == 0) {
    return Abort::unsupported_access;
  }
  return transfer == CO_OBJ_UPLOAD ? Abort::write_only : Abort::read_only;
}

// Returns whether the entry of the channel's transfer is still at the same position in the dictionary.
bool is_same_position(const CO_DICT& dict, const CO_SDO& channel) {
  const auto offset = reinterpret_cast<uintptr_t>(channel.Obj) - reinterpret_cast<uintptr_t>(dict.Root);
  return offset < dict.Num * sizeof(CO_OBJ) && CO_GET_DEV(channel.Obj->Key) == channel.Key;
}

}  // namespace

Abort check(const CO_NODE& node, uint32_t key, const CO_OBJ* obj, CO_OBJ_TRANSFER transfer) {
  CO_ASSERT(CO_GET_DEV(key) == key);
  if (obj == nullptr) {
    return dict::has_index(node.Dict, key) ? Abort::no_sub_index : Abort::no_object;
  }
  const CO_OBJ_TYPE& type = *obj->Type;
  const bool is_permitted = transfer == CO_OBJ_UPLOAD ? CO_IS_READ(obj->Key) != 0 && type.Read != nullptr
                                                      : CO_IS_WRITE(obj->Key) != 0 && type.Write != nullptr;
  if (!is_permitted) {
    return refusal(*obj, transfer);
  }
  return type.Size != nullptr ? Abort::none : Abort::not_stored;
}

void end_transfer(CO_NODE& node, CO_SDO& channel) {
  CO_ASSERT(channel.Obj != nullptr && channel.Obj->Type != nullptr);
  CO_OBJ& obj = *channel.Obj;
  channel.Obj = nullptr;
  if (is_begun(channel)) {
    (void)obj::end(obj, node, direction_of(channel), Abort::device_state);
  }
}

void close_moved(CO_NODE& node) {
  for (CO_SDO& channel : node.Sdo) {
    if (channel.Obj != nullptr && !is_same_position(node.Dict, channel)) {
      channel.Obj = nullptr;
    }
  }
}

bool is_open(const CO_NODE& node, const CO_OBJ& obj) {
  for (const CO_SDO& channel : node.Sdo) {
    if (channel.Obj == &obj) {
      return true;
    }
  }
  return false;
}

#if USE_OD
uint32_t total_of(const CO_NODE& node, const CO_OBJ& obj) {
  for (const CO_SDO& channel : node.Sdo) {
    if (channel.Obj == &obj) {
      return channel.Flow.Size;
    }
  }
  return 0;
}
#endif

// Accepts length 0 for every stream: such a download empties it.
Abort check_length(CO_NODE& node, CO_OBJ& obj, uint32_t length) {
  if (length == 0 && obj::is_stream(obj)) {
    return Abort::none;
  }
  const uint32_t need = size(obj, node, length);
  const bool failed = need == 0 && !obj::is_stream(obj);
  return failed ? abort_for(node, CO_ERR_TYPE_WR) : compare_length(length, need);
}

Abort abort_for(const CO_NODE& node, CO_ERR err) {
  CO_ASSERT(node.Request != nullptr);
  const Abort abort{node.Request->Abort};
  return abort != Abort::none ? abort : abort_code(err);
}

Abort report_failure(CO_NODE& node, CO_OBJ_TRANSFER transfer, CO_ERR err) {
  const Abort abort = abort_for(node, err);
  if (abort == Abort::hardware) {
    CO_ASSERT(node.Request->Obj != nullptr);
    error::report(node, transfer == CO_OBJ_UPLOAD ? CO_ERR_SDO_READ : CO_ERR_SDO_WRITE, node.Request->Obj->Key);
  }
  return abort;
}

}  // namespace co::access

extern "C" void COObjTypeUserSDOAbort(CO_OBJ* obj, CO_NODE_T* node, uint32_t abort) {
  if (node != nullptr && node->Request != nullptr && node->Request->Obj == obj) {
    node->Request->Abort = abort;
  }
}
