// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_RESERVED_INDEX, co::Index<'0', '0', '0', '7'>, co::Sub<'0', '0'>
// 0007h stands for UNSIGNED32 itself and holds nothing.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x0007, 0, CO_OBJ____P_W), CO_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
