// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NO_DATA, co::Index<'2', '1', '0', '0'>, co::Sub<'0', '0'>
// Error status bits without their CO_EMCY_BITS.
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2100, 0, CO_OBJ_____R_), CO_TEMCY_BITS, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
