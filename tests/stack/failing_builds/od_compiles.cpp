// SPDX-License-Identifier: Apache-2.0
// expect to compile
// An extensible dictionary that has no faults.
#define USE_OD 1
#define OD_ALL
#include "co_od.h"
#include "lexican/object.hpp"

std::uint32_t number;
CO_OBJ_DOM domain;
const CO_OBJ_TYPE own = {};
constexpr OD_TYPE own_type = OD_VALUE(&own, OD_DISABLED);

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x2101, 0, CO_OBJ__N__RW), OD_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x2102, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
    {CO_KEY(0x2103, 0, CO_OBJ_____RW), OD_TNUMBER, (CO_DATA)(4)},
    {CO_KEY(0x2104, 0, CO_OBJ_____RW), OD_TSTREAM, 0},
    {CO_KEY(0x2105, 0, CO_OBJ_____RW), OD_TSTREAM, (CO_DATA)(20)},
    {CO_KEY(0x2106, 0, CO_OBJ_____RW), &own_type.Ex.Type, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto access(CO_NODE& node) { return co::object<od, 0x2100, 0, std::uint32_t>(node); }
