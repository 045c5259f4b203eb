// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_ADDRESS, co::Index<'6', '0', '0', '0'>, co::Sub<'1', '0'>
// A value without flag D, in an extensible entry.
#define USE_OD 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x6000, 0x10, CO_OBJ_____R_), OD_TUNSIGNED32, (CO_DATA)(5)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
