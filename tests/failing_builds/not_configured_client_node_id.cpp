// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '2', 'F', 'F'>, co::Sub<'0', '3'>
// The last of all SDO clients, and nothing but the node-ID of its server.
#define CO_CSDO_N 100
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x12E3, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x12FF, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
