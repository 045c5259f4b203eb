// SPDX-License-Identifier: Apache-2.0
// expect to compile
// Objects whose content the application provides: 1002h, 1021h to 1027h, error status bits.
#include "lexican/dictionary.hpp"

std::uint32_t status;
CO_OBJ_DOM_RO eds;
CO_OS_COMMAND os;
CO_OS_COMMAND debugger;
CO_OS_PROMPT prompt;
extern const CO_MODULE_LIST modules;
CO_EMCY_BITS bits;

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1002, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&status)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1021, 0, CO_OBJ_____R_), CO_TDOMAIN_RO, (CO_DATA)(&eds)},
    {CO_KEY(0x1022, 0, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(CO_EDS_FORMAT_ZLIB)},
    {CO_KEY(0x1023, 1, CO_OBJ_____RW), CO_TOS_COMMAND, (CO_DATA)(&os)},
    {CO_KEY(0x1023, 2, CO_OBJ_____R_), CO_TOS_STATUS, (CO_DATA)(&os)},
    {CO_KEY(0x1023, 3, CO_OBJ_____R_), CO_TOS_REPLY, (CO_DATA)(&os)},
    {CO_KEY(0x1024, 0, CO_OBJ______W), CO_TOS_MODE, (CO_DATA)(&os)},
    {CO_KEY(0x1025, 1, CO_OBJ_____RW), CO_TOS_COMMAND, (CO_DATA)(&debugger)},
    {CO_KEY(0x1025, 2, CO_OBJ_____R_), CO_TOS_STATUS, (CO_DATA)(&debugger)},
    {CO_KEY(0x1025, 3, CO_OBJ_____R_), CO_TOS_REPLY, (CO_DATA)(&debugger)},
    {CO_KEY(0x1026, 1, CO_OBJ____P_W), CO_TOS_STDIN, (CO_DATA)(&prompt)},
    {CO_KEY(0x1026, 2, CO_OBJ____PR_), CO_TOS_STDOUT, (CO_DATA)(&prompt)},
    {CO_KEY(0x1026, 3, CO_OBJ____PR_), CO_TOS_STDOUT, (CO_DATA)(&prompt)},
    {CO_KEY(0x1027, 0, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&modules)},
    {CO_KEY(0x1027, 1, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&modules)},
    {CO_KEY(0x1027, 254, CO_OBJ_____R_), CO_TMODULE_LIST, (CO_DATA)(&modules)},
    {CO_KEY(0x2100, 0, CO_OBJ____PR_), CO_TEMCY_BITS, (CO_DATA)(&bits)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);
