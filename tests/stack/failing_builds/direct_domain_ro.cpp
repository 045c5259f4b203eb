// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_TYPE, co::Index<'1', '0', '2', '1'>, co::Sub<'0', '0'>
// A constant domain with a value in the table.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1021, 0, CO_OBJ_D___R_), CO_TDOMAIN_RO, (CO_DATA)(1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
