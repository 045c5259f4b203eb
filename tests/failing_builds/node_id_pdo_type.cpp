// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NODEID_TYPE, co::Index<'1', '4', '0', '0'>, co::Sub<'0', '2'>
// A transmission type cannot be relative to the node-ID.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(0x200)},
    {CO_KEY(0x1400, 2, CO_OBJ_DN__R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
