// SPDX-License-Identifier: Apache-2.0
// expect to compile
// An SRDO and a PDO map the same static data type, and different objects. A mapping entry beyond the number of mapped
// objects is not used.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

unsigned char inverse, other;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1381, 0, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(2)},
    {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x0005, 0, 8))},
    {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x0005, 0, 8))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2002, 0, 8))},
    {CO_KEY(0x1600, 3, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&inverse)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&other)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
