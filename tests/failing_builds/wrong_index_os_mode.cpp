// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '2', '5'>, co::Sub<'0', '0'>
// The debugger interface has no mode.
#include "lexican/dictionary.hpp"

CO_OS_COMMAND os;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1025, 0, CO_OBJ______W), CO_TOS_MODE, (CO_DATA)(&os)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
