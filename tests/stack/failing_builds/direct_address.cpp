// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_ADDRESS, co::Index<'2', '0', '0', '0'>, co::Sub<'0', '0'>
// Flag D, but the address of a variable.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
