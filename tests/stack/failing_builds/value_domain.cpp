// SPDX-License-Identifier: Apache-2.0
// expect: ValueType<void, co::Index<'2', '1', '0', '0'>, co::Sub<'0', '1'>, false>
// A domain is no value.
#include "lexican/object.hpp"

CO_OBJ_DOM object;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&object)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto access(CO_NODE& node) { return co::object<od, 0x2100, 1>(node); }
