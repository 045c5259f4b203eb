// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '3', 'F', 'F'>, co::Sub<'0', '1'>
// 13FEh contains whether the configuration is valid.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x13FF, 1, CO_OBJ_D___R_), CO_TSRDO_VALID, (CO_DATA)(0xA5)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
