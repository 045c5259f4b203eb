// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_MISSING, co::Index<'1', '0', '1', '8'>, co::Sub<'0', '1'>
// The vendor-ID is missing.
#include "lexican/dictionary.hpp"

std::uint8_t error_register;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
