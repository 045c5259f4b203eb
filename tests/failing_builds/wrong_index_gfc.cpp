// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '3', '5', '0'>, co::Sub<'0', '0'>
// 1300h is the global fail-safe command.
#define USE_GFC 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1350, 0, CO_OBJ_D___R_), CO_TGFC, (CO_DATA)(1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
