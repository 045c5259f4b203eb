// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'1', '0', '1', '7'>, co::Sub<'0', '0'>
// The type of 1016h at the index of the producer.
#include "lexican/dictionary.hpp"

CO_HBCONS consumer;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&consumer)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
