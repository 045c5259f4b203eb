// SPDX-License-Identifier: Apache-2.0
// Dictionaries with each kind of value of CO_OBJ.Data. The test checks in the object file that the compiler has placed
// them in read-only memory, without initialisation at the start of the program.
#include <cstdint>

#include "co_core.h"

enum Plain { plain = 1 };
enum class Scoped : std::uint8_t { scoped = 2 };

extern std::uint8_t byte;
extern std::uint32_t array[4];
extern volatile std::uint16_t reg;
extern const std::uint8_t constant;
extern CO_OBJ_DOM domain;
extern const CO_OBJ_TYPE own;
void function(int);
int variadic(const char*, ...);
void quiet() noexcept;
struct Group {
  std::uint8_t first;
  std::uint32_t second;
};
extern Group group;

extern const CO_OBJ table_const[];
extern const CO_OBJ table_constexpr[];

std::uint32_t size(CO_OBJ*, CO_NODE*, std::uint32_t);
extern const CO_OBJ_TYPE_EX table_of_functions;
const CO_OBJ_TYPE_EX table_of_functions = {{size, nullptr, nullptr, nullptr, COObjTypeExReset}, {}, {}, {}};

// clang-format off
#define ENTRIES                                                                \
  {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(1)},            \
  {CO_KEY(0x1000, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(-1)},           \
  {CO_KEY(0x1000, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(plain)},        \
  {CO_KEY(0x1000, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(Scoped::scoped)}, \
  {CO_KEY(0x1000, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, 0x80000000u},             \
  {CO_KEY(0x1000, 5, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)true},           \
  {CO_KEY(0x2000, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&byte)},         \
  {CO_KEY(0x2000, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)&array[2]},      \
  {CO_KEY(0x2000, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)array},          \
  {CO_KEY(0x2000, 3, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&(group.second))}, \
  {CO_KEY(0x2000, 4, CO_OBJ_____R_), CO_TDOMAIN, (CO_DATA)(&domain)},          \
  {CO_KEY(0x2000, 5, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&constant)},     \
  {CO_KEY(0x2000, 6, CO_OBJ_____R_), CO_TUNSIGNED16, (CO_DATA)(&reg)},         \
  {CO_KEY(0x2000, 7, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)((void *)&byte)}, \
  {CO_KEY(0x3000, 0, CO_OBJ_____R_), &own, (CO_DATA)"text"},                   \
  {CO_KEY(0x3000, 1, CO_OBJ_____R_), &own, (CO_DATA)function},                 \
  {CO_KEY(0x3000, 2, CO_OBJ_____R_), &own, (CO_DATA)(&variadic)},              \
  {CO_KEY(0x3000, 3, CO_OBJ_____R_), &own, (CO_DATA)&quiet},                   \
  {CO_KEY(0x3000, 4, CO_OBJ_____R_), &own, (CO_DATA)nullptr},                  \
  {CO_KEY(0x3000, 5, CO_OBJ_____R_), &table_of_functions.Type, (CO_DATA)(&byte)}

const CO_OBJ table_const[] = {ENTRIES, CO_OBJ_DICT_ENDMARK};
constexpr CO_OBJ table_constexpr[] = {ENTRIES, CO_OBJ_DICT_ENDMARK};
// clang-format on
