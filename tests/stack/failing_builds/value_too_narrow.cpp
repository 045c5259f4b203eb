// SPDX-License-Identifier: Apache-2.0
// expect: ValueType<signed char, co::Index<'2', '1', '0', '0'>, co::Sub<'0', '1'>, false>
// An UNSIGNED32 does not fit into 16 bits.
#include "lexican/object.hpp"

std::uint32_t object;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&object)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto access(CO_NODE& node) { return co::object<od, 0x2100, 1, std::int8_t>(node); }
