// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_RESERVED_INDEX, co::Index<'0', '0', '0', '0'>, co::Sub<'0', '1'>
// There is no index 0000h.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x0000, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(5)},
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
