// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_ASCENDING, co::Index<'2', 'A', 'B', 'C'>, co::Sub<'0', '1'>
// The sub-indexes of an object are not in order.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2ABC, 2, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    {CO_KEY(0x2ABC, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
