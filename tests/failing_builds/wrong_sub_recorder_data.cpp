// SPDX-License-Identifier: Apache-2.0
// expect: Dictionary<CO_DICT_WRONG_PLACE, co::Index<'2', '4', '0', '1'>, co::Sub<'0', '5'>
// Sub-index 5 is the plot, which requires CO_TREC_PLOT: CO_TREC_DATA is not permitted.
#define USE_RECORDER 1
#include "lexican/dictionary.hpp"

CO_RECORDER recorder;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
