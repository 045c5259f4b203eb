// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '8', '0', '0'>, co::Sub<'0', '3'>
// Sub-index 3 of 1800h is the inhibit time and no transmission type.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1800, 3, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
