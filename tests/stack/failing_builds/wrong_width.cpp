// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '0', '0'>, co::Sub<'0', '0'>
// The device type has 4 bytes. [CiA 301, 7.5.2.1]
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
