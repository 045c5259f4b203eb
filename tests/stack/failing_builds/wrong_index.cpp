// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '1', '8'>, co::Sub<'0', '0'>
// The type of 1017h at another index.
#include "lexican/dictionary.hpp"

std::uint16_t heartbeat_time;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
