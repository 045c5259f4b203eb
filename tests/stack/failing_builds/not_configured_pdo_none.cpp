// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '4', '0', '0'>, co::Sub<'0', '1'>
// A node without RPDOs.
#define CO_RPDO_N 0
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x201)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
