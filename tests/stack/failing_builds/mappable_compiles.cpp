// SPDX-License-Identifier: Apache-2.0
// expect to compile
// Mappings without an object that lacks flag P: entries above sub 0, entries of multiplex PDOs, empty ones, static data
// types, and mappings in variables.
#define CO_MPDO_N 16
#include "lexican/dictionary.hpp"

std::uint8_t mappable;
std::uint8_t other;
std::uint32_t mapping = CO_LINK(0x2001, 0, 8);

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x0005, 0, 8))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 8))},
    {CO_KEY(0x1600, 3, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1601, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0)},
    {CO_KEY(0x1601, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1602, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0xFF)},
    {CO_KEY(0x1602, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(0)},
    {CO_KEY(0x1A00, 2, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&mapping)},
    {CO_KEY(0x1A00, 65, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x1C00, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&mappable)},
    {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&other)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
