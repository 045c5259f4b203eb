// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '0', '3'>, co::Sub<'F', 'F'>
// 1003h has 254 entries.
#include "lexican/dictionary.hpp"

std::uint32_t entry;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1003, 254, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&entry)},
    {CO_KEY(0x1003, 255, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&entry)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
