// SPDX-License-Identifier: Apache-2.0
// expect a warning: safety_object_in_pdo
// expect a warning: co::Index<'2', '0', '0', '1'>
// expect a warning: co::Sub<'0', '3'>
// expect a warning: a PDO and an SRDO map this object; map a copy of it into the PDO
// An RPDO maps the inverted data of an SRDO.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

unsigned char plain, inverse, other;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1381, 0, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(2)},
    {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 8))},
    {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2001, 3, 8))},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2002, 0, 8))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 3, 8))},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&plain)},
    {CO_KEY(0x2001, 3, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&inverse)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&other)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK_PART(od);
