// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '3', '0', '3'>, co::Sub<'0', '1'>
// An SRDO beyond CO_SRDO_N.
#define CO_SRDO_N 2
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1302, 1, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(1)},
    {CO_KEY(0x1303, 1, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
