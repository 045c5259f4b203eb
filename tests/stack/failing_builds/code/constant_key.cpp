// SPDX-License-Identifier: Apache-2.0
// The optimised program must keep only the access to the variable, or the value, of these functions.
#include "lexican/dictionary.hpp"

extern std::uint32_t speed;

namespace {

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2100, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&speed)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK_PART(od);

}  // namespace

std::uint8_t read_value() { return static_cast<std::uint8_t>(co::entry<od, 0x2100, 0>()->Data); }
std::uint32_t read_variable() { return *static_cast<const std::uint32_t*>(co::entry<od, 0x2100, 1>()->Data); }
void write_variable(std::uint32_t to) { *static_cast<std::uint32_t*>(co::entry<od, 0x2100, 1>()->Data) = to; }
