// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '0', '4'>, co::Sub<'0', '1'>
// The type of 1003h at another index.
#include "lexican/dictionary.hpp"

std::uint32_t entry;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1004, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&entry)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
