// SPDX-License-Identifier: Apache-2.0
// expect to compile
// Objects with plain types whose content the application provides: 1002h, 1021h, 1022h, error status bits.
#include "lexican/dictionary.hpp"

std::uint32_t status;
CO_OBJ_DOM_RO eds;
CO_EMCY_BITS bits;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1002, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&status)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1021, 0, CO_OBJ_____R_), CO_TDOMAIN_RO, (CO_DATA)(&eds)},
    {CO_KEY(0x1022, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(CO_EDS_FORMAT_ZLIB)},
    {CO_KEY(0x2100, 0, CO_OBJ____PR_), CO_TEMCY_BITS, (CO_DATA)(&bits)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
