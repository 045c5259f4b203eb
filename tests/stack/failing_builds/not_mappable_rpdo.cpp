// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_MAPPABLE, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// An RPDO of the table maps an object that has no flag P; how many objects it maps is in a variable.
#include "lexican/dictionary.hpp"

std::uint8_t number = 1;
std::uint16_t value;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1600, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&number)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_LINK(0x2000, 0, 16))},
    {CO_KEY(0x2000, 0, CO_OBJ______W), CO_TUNSIGNED16, (CO_DATA)(&value)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
