// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', 'B', 'F', 'F'>, co::Sub<'0', '1'>
// The mapping of a TPDO beyond CO_TPDO_N, as a plain number.
#define CO_RPDO_N 4
#define CO_TPDO_N 4
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1A03, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x20000008)},
    {CO_KEY(0x1BFF, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x20000008)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
