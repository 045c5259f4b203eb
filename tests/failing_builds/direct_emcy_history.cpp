// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_DIRECT_TYPE, co::Index<'1', '0', '0', '3'>, co::Sub<'0', '1'>
// The node writes the entries of 1003h; this table is in read-only memory.
#include "lexican/dictionary.hpp"

std::uint8_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)(&number)},
    {CO_KEY(0x1003, 1, CO_OBJ_D___R_), CO_TEMCY_HIST, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
