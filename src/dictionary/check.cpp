// SPDX-License-Identifier: Apache-2.0
// Check of the dictionary at run time.
#include "base/texts.hpp"
#include "co_core.h"
#include "co_dict.h"
#include "dictionary/dict.hpp"

namespace co::dict {

#if USE_DICT_CHECK

CO_ERR check(CO_DICT& dict) {
  uint32_t key_before = 0;
  for (uint16_t n = 0; n < dict.Num; ++n) {
    const CO_OBJ& entry = dict.Root[n];
    dict.Fault = rules::check_entry(key_before, entry.Key, entry.Type != nullptr, false);
    if (dict.Fault != CO_DICT_OK) {
      dict.FaultKey = entry.Key;
      return CO_ERR_DICT_INIT;
    }
    key_before = entry.Key;
  }
  return CO_ERR_NONE;
}

CO_ERR set_fault(const CO_OBJ& obj, CO_NODE_T& node, CO_DICT_FAULT fault) {
  if (node.Dict.Fault == CO_DICT_OK || (rules::stops_node(fault) && !stops_node(node.Dict))) {
    node.Dict.Fault = fault;
    node.Dict.FaultKey = obj.Key;
  }
  return CO_ERR_TYPE_INIT;
}

CO_ERR check_type(const CO_OBJ& obj, CO_NODE_T& node, const rules::Rule& rule) {
  const CO_DICT_FAULT fault = rules::check_type(rule, obj.Key, uintptr_t{obj.Data} != 0);
  return fault == CO_DICT_OK ? CO_ERR_NONE : set_fault(obj, node, fault);
}

#else

uint32_t out_of_order(const CO_DICT& dict) {
  for (uint16_t n = 1; n < dict.Num; ++n) {
    if ((dict.Root[n].Key >> 8) <= (dict.Root[n - 1].Key >> 8)) {
      return dict.Root[n].Key;
    }
  }
  return 0;
}

#endif

namespace {

constexpr uint32_t numbers[] = {CO_DICT_FAULT_LIST(CO_DICT_FAULT_NUMBERS)};

constexpr bool is_consecutive() {
  uint32_t expected = 1;
  for (const uint32_t number : numbers) {
    if (number != expected) {
      return false;
    }
    ++expected;
  }
  return true;
}
static_assert(is_consecutive(), "CO_DICT_FAULT_LIST: each number is one more than the number before");

constexpr char meanings[] = "no fault\0" CO_DICT_FAULT_LIST(CO_DICT_FAULT_TEXT_AND_NUL);
constexpr char names[] = "CO_DICT_OK\0" CO_DICT_FAULT_LIST(CO_DICT_FAULT_NAME_AND_NUL);

}  // namespace
}  // namespace co::dict

extern "C" const char* CODictFaultName(CO_DICT_FAULT fault) {
  return co::texts::find(co::dict::names, static_cast<uint32_t>(fault), "unknown fault");
}

extern "C" const char* CODictFaultText(CO_DICT_FAULT fault) {
  return co::texts::find(co::dict::meanings, static_cast<uint32_t>(fault), "unknown fault");
}
