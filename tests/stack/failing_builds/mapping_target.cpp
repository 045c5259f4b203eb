// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_MAP_TARGET, co::Index<'1', 'A', '0', '0'>, co::Sub<'0', '2'>
// A TPDO of the table maps an object that the table does not have.
#include "lexican/dictionary.hpp"

std::uint8_t first;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 1, 8))},
    {CO_KEY(0x2001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&first)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
