// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '3', '8', '1'>, co::Sub<'1', '1'>
// An SRDO maps 16 objects.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1381, 16, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(0)},
    {CO_KEY(0x1381, 17, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
