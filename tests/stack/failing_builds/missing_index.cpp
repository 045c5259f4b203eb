// SPDX-License-Identifier: Apache-2.0
// expect: Entry<co::Index<'2', '1', 'A', 'F'>, co::Sub<'0', '1'>, false>
// Look-up of an index that the dictionary does not have.
#include "lexican/dictionary.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

CO_OBJ* const entry = co::entry<od, 0x21AF, 1>();
