// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', 'F', 'D', '0'>, co::Sub<'0', '0'>
// Sub 0 of the object dispatching list is the number of its entries.
#define CO_MPDO_N 16
#include "lexican/dictionary.hpp"

unsigned long long entry;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1FD0, 0, CO_OBJ_____RW), CO_TPDO_DISPATCH, (CO_DATA)(&entry)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
