// SPDX-License-Identifier: Apache-2.0
// Default values of variables that no parameter group stores. [301:7.3.2.2.1]
#include "co_dict.h"
#include "dictionary/obj.hpp"

namespace co::defaults {
namespace {

void set_default(const CO_DEFAULTS& block) {
  if (block.Default == nullptr) {
    __builtin_memset(block.Start, 0, block.Size);
  } else {
    __builtin_memcpy(block.Start, block.Default, block.Size);
  }
}

// Sets the default values of a reset; reset node includes the values of reset communication.
CO_ERR reset(CO_OBJ* end, CO_NODE_T*, uint32_t type) {
  const auto* block = data_of<const CO_DEFAULTS>(*end);
  for (; block != nullptr && block->Size != 0; ++block) {
    if (type == CO_RESET_NODE || block->Type == CO_RESET_COM) {
      set_default(*block);
    }
  }
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::defaults

extern "C" {

const CO_OBJ_TYPE COTDefaults = {nullptr, nullptr, nullptr, nullptr, co::defaults::reset};

}  // extern "C"
