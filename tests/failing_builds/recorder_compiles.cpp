// SPDX-License-Identifier: Apache-2.0
// expect to compile
// All entries of a recorder.
#define USE_RECORDER 1
#include "lexican/dictionary.hpp"

CO_RECORDER recorder;
std::uint8_t enable;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2301, 1, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 2, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 3, CO_OBJ_____RW), CO_TVISIBLE_STRING, (CO_DATA)(&recorder.Name)},
    {CO_KEY(0x2301, 4, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 5, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 6, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 7, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 8, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 9, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2301, 10, CO_OBJ_____RW), CO_TREC_CONFIG, (CO_DATA)(&recorder)},
    {CO_KEY(0x2400, 0, CO_OBJ_____RW), CO_TREC_ENABLE, (CO_DATA)(&enable)},
    {CO_KEY(0x2401, 1, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 2, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 3, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 4, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 5, CO_OBJ_____R_), CO_TREC_PLOT, (CO_DATA)(&recorder)},
    {CO_KEY(0x2401, 6, CO_OBJ_____R_), CO_TREC_DATA, (CO_DATA)(&recorder)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
