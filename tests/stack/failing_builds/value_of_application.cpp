// SPDX-License-Identifier: Apache-2.0
// expect: ValueType<void, co::Index<'2', '1', '0', '0'>, co::Sub<'0', '1'>, false>
// What a type of the application holds must be said.
#include "lexican/object.hpp"

const CO_OBJ_TYPE type = {};
std::uint32_t object;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), &type, (CO_DATA)(&object)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto access(CO_NODE& node) { return co::object<od, 0x2100, 1>(node); }
