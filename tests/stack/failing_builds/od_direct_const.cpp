// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_CONST, co::Index<'6', '0', '0', '0'>, co::Sub<'1', '0'>
// An extensible value that can be written lies in read-only memory.
#define USE_OD 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x6000, 0x10, CO_OBJ_D___RW), OD_TUNSIGNED32, (CO_DATA)(5)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
