// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_NOT_CONFIGURED, co::Index<'1', '8', '0', '4'>, co::Sub<'0', '5'>
// The event timer of a TPDO beyond CO_TPDO_N, which would lie outside of the node.
#define CO_RPDO_N 5
#define CO_TPDO_N 4
#include "lexican/dictionary.hpp"

std::uint16_t time;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1803, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&time)},
    {CO_KEY(0x1804, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&time)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
