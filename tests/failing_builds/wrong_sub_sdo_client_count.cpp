// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '2', '8', '0'>, co::Sub<'0', '0'>
// Sub-index 0 of 1280h is the number of its sub-indices and no COB-ID.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(3)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
