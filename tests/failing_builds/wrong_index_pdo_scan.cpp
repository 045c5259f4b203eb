// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', 'F', 'D', '0'>, co::Sub<'0', '1'>
// The object dispatching list is none of scanned objects.
#define CO_MPDO_N 16
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1FA0, 1, CO_OBJ_D___R_), CO_TPDO_SCAN, (CO_DATA)(CO_MPDO_SCAN(1, 0x2000, 1))},
    {CO_KEY(0x1FD0, 1, CO_OBJ_D___R_), CO_TPDO_SCAN, (CO_DATA)(CO_MPDO_SCAN(1, 0x2000, 1))},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
