// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'2', '3', '0', '1'>, co::Sub<'0', '3'>
// Sub-index 3 is the name, a string: CO_TREC_CONFIG is not permitted.
#define USE_RECORDER 1
#include "lexican/dictionary.hpp"

CO_RECORDER recorder;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2301, 3, CO_OBJ_____R_), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
