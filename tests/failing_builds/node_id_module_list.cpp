// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NODEID_TYPE, co::Index<'1', '0', '2', '7'>, co::Sub<'0', '1'>
// A module type relative to the node-ID.
#include "lexican/dictionary.hpp"

extern const CO_MODULE_LIST modules;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1027, 1, CO_OBJ__N__R_), CO_TMODULE_LIST, (CO_DATA)(&modules)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
