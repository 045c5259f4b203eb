// SPDX-License-Identifier: Apache-2.0
// Replaces the dictionary of a running node. Only programs that call CODictInit() link it.
#include "base/error.hpp"
#include "base/events.hpp"
#include "co_core.h"
#include "dictionary/access.hpp"
#include "dictionary/dict.hpp"
#include "node/services.hpp"

using namespace co;

extern "C" int16_t CODictInit(CO_DICT* cod, CO_NODE_T* node, CO_OBJ* root, uint16_t max) {
  if (cod == nullptr || node == nullptr || root == nullptr || max == 0) {
    return -1;
  }
  if (event::is_serving(*node)) {
    error::report(*node, CO_ERR_DICT_BUSY);
    return -1;
  }
  const event::Call call(*node);
  const CO_ERR err = dict::set_table(*cod, *node, root, max);
  access::close_moved(*node);  // SDO transfers whose entry is no longer at the same address
  if ((node->State & event::running) != 0) {
    services::remap(*node);
  }
  if (err != CO_ERR_NONE) {
    return -1;
  }
  return static_cast<int16_t>(cod->Num < INT16_MAX ? cod->Num : INT16_MAX);
}
