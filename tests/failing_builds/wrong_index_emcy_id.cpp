// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '1', '5'>, co::Sub<'0', '0'>
// The type of 1014h at another index.
#include "lexican/dictionary.hpp"

std::uint32_t cob_id;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1015, 0, CO_OBJ_____RW), CO_TEMCY_ID, (CO_DATA)(&cob_id)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
