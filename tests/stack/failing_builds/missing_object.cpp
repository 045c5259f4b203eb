// SPDX-License-Identifier: Apache-2.0
// expect: Entry<co::Index<'2', '1', '0', '1'>, co::Sub<'0', '0'>, false>
// Typed access to an entry that the dictionary does not have.
#include "lexican/object.hpp"

std::uint32_t number;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&number)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto object(CO_NODE& node) { return co::object<od, 0x2101, 0>(node); }
