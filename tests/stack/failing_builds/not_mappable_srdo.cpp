// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_MAPPABLE, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// An SRDO maps an object without flag P.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

unsigned char plain, inverse;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1381, 0, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(2)},
    {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 8))},
    {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&plain)},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&inverse)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
