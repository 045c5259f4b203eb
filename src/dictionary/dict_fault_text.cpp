// SPDX-License-Identifier: Apache-2.0
#include "base/texts.hpp"
#include "co_dict.h"

namespace co::dict {
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
