// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '6', '0', '4'>, co::Sub<'0', '0'>
// The mapping of an RPDO beyond CO_RPDO_N.
#define CO_RPDO_N 4
#define CO_TPDO_N 5
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1603, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0)},
    {CO_KEY(0x1604, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
