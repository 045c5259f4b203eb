// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '0', '2', '8'>, co::Sub<'0', '3'>
// A node beyond CO_EMCY_CONS_N.
#define CO_EMCY_CONS_N 2
#include "co_emcy.h"
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1028, 2, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(CO_COBID_EMCY_STD(1, 0x82))},
    {CO_KEY(0x1028, 3, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(CO_COBID_EMCY_STD(1, 0x83))},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
