// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NO_DATA, co::Index<'1', '0', '0', '1'>, co::Sub<'0', '0'>
// A table inside a function is checked as well.
#include "lexican/dictionary.hpp"

void scope() {
  static constexpr CO_OBJ od[] = {{CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, 0}};
  CO_OD_CHECK(od);
  static_cast<void>(od);
}
