// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '5', '0'>, co::Sub<'0', '0'>
// A module list at another index than 1027h.
#include "lexican/dictionary.hpp"

extern const CO_MODULE_LIST modules;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1050, 0, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&modules)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
