// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '2', '0', '0'>, co::Sub<'0', '3'>
// Sub-index 3 of 1200h is a node-ID and no COB-ID.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 3, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
