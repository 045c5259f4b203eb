// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '8', '0', '1'>, co::Sub<'0', '5'>
// Sub-index 5 of 1801h is the event timer and no inhibit time.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1801, 5, CO_OBJ_D___R_), CO_TPDO_INHIBIT, (CO_DATA)(100)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
