// SPDX-License-Identifier: Apache-2.0
#include "dictionary/obj.hpp"

#include "base/events.hpp"
#include "hal/port.hpp"

namespace co::obj {

CO_ERR write_for_application(CO_OBJ& obj, CO_NODE_T& node, void* buffer, uint32_t size) {
  return port::is_initialised(node) ? write(obj, node, buffer, size) : CO_ERR_BAD_ARG;
}

CO_ERR begin(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, uint32_t size) {
  const CO_OBJ_TYPE_EX* const type = extended(obj);
  return type == nullptr || type->Begin == nullptr ? CO_ERR_NONE : type->Begin(&obj, &node, transfer, size);
}

CO_ERR end(CO_OBJ& obj, CO_NODE_T& node, CO_OBJ_TRANSFER transfer, Abort abort) {
  const CO_OBJ_TYPE_EX* const type = extended(obj);
  return type == nullptr || type->End == nullptr ? CO_ERR_NONE
                                                 : type->End(&obj, &node, transfer, static_cast<uint32_t>(abort));
}

}  // namespace co::obj

namespace co::obj {
namespace {

// Returns whether an API function can access the object: it has a type, and no argument is null.
bool is_accessible(const CO_OBJ* obj, const CO_NODE_T* node) {
  return obj != nullptr && obj->Type != nullptr && node != nullptr;
}

}  // namespace
}  // namespace co::obj

extern "C" {

uint32_t COObjGetSize(CO_OBJ* obj, CO_NODE_T* node, uint32_t width) {
  if (!co::obj::is_accessible(obj, node)) {
    return 0;
  }
  const co::event::Call call(*node);
  return co::obj::size(*obj, *node, width);
}

CO_ERR COObjInit(CO_OBJ* obj, CO_NODE_T* node) {
  if (!co::obj::is_accessible(obj, node)) {
    return CO_ERR_BAD_ARG;
  }
  return obj->Type->Init == nullptr ? CO_ERR_NONE : obj->Type->Init(obj, node);
}

#if USE_OBJ_EX
CO_ERR COObjTypeExReset(CO_OBJ* obj, CO_NODE_T* node, uint32_t para) {
  if (!co::obj::is_accessible(obj, node)) {
    return CO_ERR_BAD_ARG;
  }
  const CO_OBJ_TYPE_EX* const type = co::obj::extended(*obj);
  return type == nullptr || type->Reset == nullptr ? CO_ERR_NONE : type->Reset(obj, node, para);
}
#endif

CO_ERR COObjReset(CO_OBJ* obj, CO_NODE_T* node, uint32_t para) {
  if (!co::obj::is_accessible(obj, node)) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*node);
  return co::obj::seek(*obj, *node, para);
}

CO_ERR COObjRdBufCont(CO_OBJ* obj, CO_NODE_T* node, uint8_t* buffer, uint32_t size) {
  if (!co::obj::is_accessible(obj, node) || buffer == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*node);
  return co::obj::read(*obj, *node, buffer, size);
}

CO_ERR COObjWrBufCont(CO_OBJ* obj, CO_NODE_T* node, uint8_t* buffer, uint32_t size) {
  if (!co::obj::is_accessible(obj, node) || buffer == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*node);
  return co::obj::write_for_application(*obj, *node, buffer, size);
}

CO_ERR COObjRdValue(CO_OBJ* obj, CO_NODE_T* node, void* value, uint8_t width) {
  return COObjRdBufCont(obj, node, static_cast<uint8_t*>(value), width);
}

CO_ERR COObjWrValue(CO_OBJ* obj, CO_NODE_T* node, void* value, uint8_t width) {
  return COObjWrBufCont(obj, node, static_cast<uint8_t*>(value), width);
}

CO_ERR COObjRdBufStart(CO_OBJ* obj, CO_NODE_T* node, uint8_t* buffer, uint32_t size) {
  const CO_ERR err = COObjReset(obj, node, 0);
  return err != CO_ERR_NONE ? err : COObjRdBufCont(obj, node, buffer, size);
}

CO_ERR COObjWrBufStart(CO_OBJ* obj, CO_NODE_T* node, uint8_t* buffer, uint32_t size) {
  const CO_ERR err = COObjReset(obj, node, 0);
  return err != CO_ERR_NONE ? err : COObjWrBufCont(obj, node, buffer, size);
}

}  // extern "C"
