// SPDX-License-Identifier: Apache-2.0
#include "core/access.hpp"

#include "core/dict.hpp"

namespace co::access {
namespace {

bool is_permitted(const CO_OBJ& obj, CO_OBJ_TRANSFER transfer) {
  const bool has_function = transfer == CO_OBJ_UPLOAD ? obj.Type->Read != nullptr : obj.Type->Write != nullptr;
  const uint32_t right = transfer == CO_OBJ_UPLOAD ? CO_OBJ_____R_ : CO_OBJ______W;
  return (obj.Key & right) != 0 && has_function;
}

}  // namespace

uint32_t open(CO_NODE& node, uint32_t key, CO_OBJ_TRANSFER transfer, CO_OBJ*& obj) {
  CO_OBJ* const found = CODictFind(&node.Dict, key);
  if (found == nullptr) {
    return dict::has_index(node.Dict, key) ? CO_SDO_ERR_SUB : CO_SDO_ERR_OBJ;
  }
  if (!is_permitted(*found, transfer)) {
    const uint32_t refused = transfer == CO_OBJ_UPLOAD ? CO_SDO_ERR_RD : CO_SDO_ERR_WR;
    return (found->Key & CO_OBJ_____RW) == 0 ? CO_SDO_ERR_UNSUP : refused;
  }
  if (found->Type->Size == nullptr) {
    return CO_SDO_ERR_TOS;
  }
  obj = found;
  serve(node, obj);
  return no_abort;
}

void serve(CO_NODE& node, CO_OBJ* obj) {
  node.Served = obj;
  node.UserAbort = no_abort;
}

bool is_taken(const CO_NODE& node, const CO_OBJ& obj, const CO_SDO* by) {
  for (const CO_SDO& channel : node.Sdo) {
    if (&channel != by && channel.Obj == &obj) {
      return true;
    }
  }
  return false;
}

// A stream may always be emptied.
uint32_t check_length(CO_NODE& node, CO_OBJ& obj, uint32_t length) {
  if (length == 0 && obj::is_stream(obj)) {
    return no_abort;
  }
  const uint32_t need = obj::size(obj, node, length);
  const bool failed = need == 0 && !obj::is_stream(obj);
  return failed ? abort_for(node, CO_ERR_TYPE_WR) : compare_length(length, need);
}

uint32_t abort_for(const CO_NODE& node, CO_ERR err) {
  return node.UserAbort != no_abort ? node.UserAbort : abort_code(err);
}

uint32_t read_failed(CO_NODE& node, CO_ERR err) {
  node.Error = CO_ERR_SDO_READ;
  return abort_for(node, err);
}

uint32_t write_failed(CO_NODE& node, CO_ERR err) {
  node.Error = CO_ERR_SDO_WRITE;
  return abort_for(node, err);
}

}  // namespace co::access

extern "C" void COObjTypeUserSDOAbort(CO_OBJ* obj, CO_NODE_T* node, uint32_t abort) {
  if (obj != nullptr && node != nullptr && node->Served == obj) {
    node->UserAbort = abort;
  }
}
