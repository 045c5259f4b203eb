// SPDX-License-Identifier: Apache-2.0
#include "base/texts.hpp"
#include "co_dict.h"

namespace co::dict {
namespace {

constexpr char meanings[] = "no fault\0" CO_DICT_FAULT_LIST(CO_DICT_FAULT_TEXT_AND_NUL);

}  // namespace
}  // namespace co::dict

extern "C" const char* CODictFaultText(CO_DICT_FAULT fault) {
  return co::texts::find(co::dict::meanings, static_cast<uint32_t>(fault), "unknown fault");
}
