// SPDX-License-Identifier: Apache-2.0
// 1027h, module list. [301:7.5.2.30]
#include "co_module_list.h"

#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "hal/port.hpp"

namespace co::module_list {
namespace {

constexpr uint16_t most_modules = 254;

uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  if (uintptr_t{obj->Data} == 0) {
    return 0;
  }
  return CO_GET_SUB(obj->Key) == 0 ? sizeof(uint8_t) : sizeof(uint16_t);
}

// Reads a value of width bytes in the byte order of the CPU.
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t width) {
  const auto* const list = data_of<const CO_MODULE_LIST>(*obj);
  if (width == 0 || width != size(obj, node, 0)) {
    return CO_ERR_BAD_ARG;
  }
  if (list->Read == nullptr) {
    return CO_ERR_OBJ_NO_DATA;
  }
  if (!port::is_initialised(*node)) {
    return CO_ERR_TYPE_RD;
  }
  uint16_t value = 0;
  const CO_ERR err = list->Read(node, node->Ext->User, CO_GET_SUB(obj->Key), &value);
  if (err != CO_ERR_NONE) {
    return err;
  }
  if (CO_GET_SUB(obj->Key) == 0 && value > most_modules) {
    return CO_ERR_TYPE_RD;
  }
  if (width == sizeof value) {
    __builtin_memcpy(buffer, &value, sizeof value);
  } else {
    *static_cast<uint8_t*>(buffer) = static_cast<uint8_t>(value);
  }
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::module_list

extern "C" const CO_OBJ_TYPE COTModuleList = {co::module_list::size, co::dict::checked_by<co::rules::module_list>,
                                              co::module_list::read, nullptr, nullptr};
