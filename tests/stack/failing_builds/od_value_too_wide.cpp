// SPDX-License-Identifier: Apache-2.0
// expect: ValueType<int, co::Index<'6', '0', '0', '0'>, co::Sub<'1', '0'>, false>
// An extensible UNSIGNED8 is not read as 16 bits.
#define USE_OD 1
#include "lexican/object.hpp"

std::uint8_t object;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x6000, 0x10, CO_OBJ_____RW), OD_TUNSIGNED8, (CO_DATA)(&object)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

auto access(CO_NODE& node) { return co::object<od, 0x6000, 0x10, int>(node); }
