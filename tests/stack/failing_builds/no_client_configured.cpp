// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '2', '8', '0'>, co::Sub<'0', '1'>
// Without SDO clients there is no first one, whatever CO_CSDO_N says.
#define USE_CSDO 0
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x605)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
