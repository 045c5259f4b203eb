// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_CONST, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// A value in read-only memory cannot be written.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ_D___RW), CO_TUNSIGNED32, (CO_DATA)(5)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
