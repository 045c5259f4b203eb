// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '3', '0', '1'>, co::Sub<'0', '0'>
// Sub-index 0 is the highest sub-index and no parameter.
#define CO_SRDO_N 1
#include "lexican/dictionary.hpp"

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1301, 0, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(6)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
