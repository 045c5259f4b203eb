// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '2', '0', '1'>, co::Sub<'0', '1'>
// An SDO server beyond CO_SSDO_N.
#define CO_SSDO_N 1
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1201, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
