// SPDX-License-Identifier: Apache-2.0
// expect: Entry<co::Index<'2', '1', '0', '0'>, co::Sub<'0', 'A'>, false>
// Look-up of a sub-index that the dictionary does not have.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

CO_OBJ* const entry = co::entry<od, 0x2100, 10>();
