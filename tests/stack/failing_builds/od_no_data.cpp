// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NO_DATA, co::Index<'6', '0', '0', '0'>, co::Sub<'1', '0'>
// An extensible UNSIGNED32 needs its variable, as any.
#define USE_OD 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x6000, 0x10, CO_OBJ_____RW), OD_TUNSIGNED32, 0},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
