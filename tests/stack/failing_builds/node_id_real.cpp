// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NODEID_TYPE, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// A REAL32 cannot be relative to the node-ID.
#include "lexican/dictionary.hpp"

float ratio;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ__N__R_), CO_TREAL32, (CO_DATA)(&ratio)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
