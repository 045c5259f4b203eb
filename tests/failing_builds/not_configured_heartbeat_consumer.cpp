// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '0', '1', '6'>, co::Sub<'0', '3'>
// More nodes than CO_HBCONS_N.
#define CO_HBCONS_N 2
#include "lexican/dictionary.hpp"

CO_HBCONS consumers[2];

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&consumers[0])},
    {CO_KEY(0x1016, 3, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&consumers[1])},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
