// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '4', '0', '3'>, co::Sub<'0', '4'>
// Sub-index 4 of 1403h is reserved and no event timer.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1403, 4, CO_OBJ_D___R_), CO_TPDO_EVENT, (CO_DATA)(100)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
