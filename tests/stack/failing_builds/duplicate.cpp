// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_ASCENDING, co::Index<'2', '0', '0', '0'>, co::Sub<'F', 'E'>
// Two entries differ in their flags only.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2000, 0xFE, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x2000, 0xFE, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
