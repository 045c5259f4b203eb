// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_MAP_LENGTH, co::Index<'1', '6', '0', '0'>, co::Sub<'0', '1'>
// An RPDO of the table maps 8 bits of an object with 16.
#include "lexican/dictionary.hpp"

std::uint16_t setpoint;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED16, (CO_DATA)(&setpoint)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
