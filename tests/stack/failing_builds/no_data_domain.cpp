// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NO_DATA, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// A domain needs the address of its CO_OBJ_DOM.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(nullptr)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
