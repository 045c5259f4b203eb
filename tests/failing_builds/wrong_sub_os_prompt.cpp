// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '2', '6'>, co::Sub<'0', '1'>
// StdIn with the type of the outputs.
#include "lexican/dictionary.hpp"

CO_OS_PROMPT prompt;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1026, 1, CO_OBJ____P_W), CO_TOS_STDOUT, (CO_DATA)(&prompt)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
