// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', 'A', '0', '0'>, co::Sub<'0', '0'>
// Sub-index 0 of 1A00h is the number of mapped objects and none of them.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(0x20000008)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
