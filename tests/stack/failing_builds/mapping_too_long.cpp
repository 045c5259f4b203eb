// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_MAP_LENGTH, co::Index<'1', 'A', '0', '1'>, co::Sub<'0', '3'>
// A TPDO of the table maps 72 bits.
#include "lexican/dictionary.hpp"

std::uint32_t count;
std::uint8_t state;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1A01, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(3)},
    {CO_KEY(0x1A01, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 32))},
    {CO_KEY(0x1A01, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 32))},
    {CO_KEY(0x1A01, 3, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2002, 0, 8))},
    {CO_KEY(0x2001, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&count)},
    {CO_KEY(0x2002, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&state)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
