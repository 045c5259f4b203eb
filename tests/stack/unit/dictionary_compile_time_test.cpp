// SPDX-License-Identifier: Apache-2.0
// Checks of a dictionary at compile time. Most of them are static assertions of this file; sources that must not
// compile are in tests/stack/failing_builds.

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <iterator>

#include "co_core.h"
#include "lexican/dictionary.hpp"

namespace {

std::uint8_t error_register;
std::uint16_t heartbeat_time;
std::uint32_t speed;
std::uint64_t distance;
float ratio;
CO_OBJ_DOM domain;
const CO_OBJ_TYPE own_type = {};
void callback() {}

enum class Answer : std::uint8_t { yes = 42 };

constexpr CO_OBJ od[] = {
    {CO_KEY(0x0005, 0, CO_OBJ____P_W), CO_TUNSIGNED8, 0},
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x000F0191)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(0x600)},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(0x580)},
    {CO_KEY(0x2100, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(Answer::yes)},
    {CO_KEY(0x2100, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&speed)},
    {CO_KEY(0x2100, 2, CO_OBJ____PRW), CO_TUNSIGNED56, (CO_DATA)(&distance)},
    {CO_KEY(0x2100, 3, CO_OBJ_____RW), CO_TREAL32, (CO_DATA)(&ratio)},
    {CO_KEY(0x2100, 4, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
    {CO_KEY(0x2100, 5, CO_OBJ_D___RW), &own_type, (CO_DATA)(&speed)},
    {CO_KEY(0x2100, 6, CO_OBJ_____RW), &own_type, (CO_DATA)(&callback)},
    {CO_KEY(0xFFFF, 0xFF, CO_OBJ_D___R_), CO_TSIGNED8, (CO_DATA)(-1)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

constexpr CO_OBJ without_end_mark[] = {{CO_KEY(0x2001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)}};
CO_OD_CHECK_PART(without_end_mark);

constexpr CO_OBJ empty[] = {CO_OBJ_DICT_ENDMARK};
CO_OD_CHECK_PART(empty);

constexpr CO_OBJ reserve[4] = {{CO_KEY(0x2001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)}};
CO_OD_CHECK_PART(reserve);

static_assert(co::find(od, CO_DEV(0x2100, 1)) == &od[10]);
static_assert(co::find(od, CO_KEY(0x2100, 1, CO_OBJ_____RW)) == &od[10], "flags do not count");
static_assert(co::find(od, CO_DEV(0x2100, 7)) == nullptr);
static_assert(co::find(od, 0) == nullptr, "the end mark is no entry");
static_assert(co::find(empty, CO_DEV(0x1001, 0)) == nullptr);
static_assert(co::find(without_end_mark, CO_DEV(0x2001, 0)) == &without_end_mark[0]);
static_assert(co::entry<od, 0x0005, 0>() == &od[0]);
static_assert(co::entry<od, 0xFFFF, 0xFF>() == &od[16]);
static_assert(co::entry<od, 0x2100, 0>()->Data == 42, "a value is known to the compiler");

// Limits of the rules.
using namespace co::rules;
constexpr std::uint32_t key = CO_KEY(0x2000, 1, CO_OBJ_____RW);

static_assert(check_entry(0, key, true, true) == CO_DICT_OK);
static_assert(check_entry(CO_KEY(0x2000, 0, 0xFF), key, true, true) == CO_DICT_OK);
static_assert(check_entry(CO_KEY(0x2000, 1, 0), key, true, true) == CO_DICT_NOT_ASCENDING);
static_assert(check_entry(CO_KEY(0x2000, 2, 0), key, true, true) == CO_DICT_NOT_ASCENDING);
static_assert(check_entry(CO_KEY(0xFFFF, 0xFF, 0xFF), key, true, true) == CO_DICT_NOT_ASCENDING);
static_assert(check_entry(0, key, false, true) == CO_DICT_NO_TYPE);
static_assert(check_entry(0, CO_KEY(0, 0xFF, 0xFF), true, false) == CO_DICT_RESERVED_INDEX);
static_assert(check_entry(0, CO_KEY(0x001F, 0, 0), true, true) == CO_DICT_RESERVED_INDEX);
static_assert(check_entry(0, CO_KEY(0x0020, 0, 0), true, true) == CO_DICT_OK);
static_assert(check_entry(0, CO_KEY(0x1200 + CO_SSDO_N - 1, 1, 0), true, true) == CO_DICT_OK);
static_assert(CO_SSDO_N == 128 ||
              check_entry(0, CO_KEY(0x1200 + CO_SSDO_N, 1, 0), true, true) == CO_DICT_NOT_CONFIGURED);
constexpr std::uint32_t clients = USE_CSDO != 0 ? CO_CSDO_N : 0;  // 1280h: SDO client parameters
static_assert(clients == 0 || check_entry(0, CO_KEY(0x1280 + clients - 1, 3, 0), true, true) == CO_DICT_OK);
static_assert(check_entry(0, CO_KEY(0x1280 + clients, 3, 0), true, true) == CO_DICT_NOT_CONFIGURED);
static_assert(check_entry(0, CO_KEY(0x1280 + clients, 4, 0), true, true) == CO_DICT_OK, "no sub-index of CiA 301");

static_assert(check_type(sdo_cob_id, CO_KEY(0x1200, 1, CO_OBJ_DN__R_), true) == CO_DICT_OK);
static_assert(check_type(sdo_cob_id, CO_KEY(0x127F, 2, 0), true) == CO_DICT_OK);
static_assert(check_type(sdo_cob_id, CO_KEY(0x12FF, 2, 0), true) == CO_DICT_OK);
static_assert(check_type(sdo_cob_id, CO_KEY(0x1300, 2, 0), true) == CO_DICT_WRONG_PLACE);
static_assert(check_type(sdo_cob_id, CO_KEY(0x11FF, 2, 0), true) == CO_DICT_WRONG_PLACE);
static_assert(check_type(sdo_cob_id, CO_KEY(0x1200, 0, 0), true) == CO_DICT_WRONG_PLACE);
static_assert(check_type(integer(8), CO_KEY(0x2000, 0, CO_OBJ_D_____), true) ==
              (sizeof(void*) >= 8 ? CO_DICT_OK : CO_DICT_DIRECT_TYPE));
static_assert(check_type(integer(2), CO_KEY(0x2000, 0, CO_OBJ_D_____), false) == CO_DICT_OK, "the value 0");
static_assert(check_type(integer(2), CO_KEY(0x2000, 0, CO_OBJ__N____), false) == CO_DICT_NO_DATA);
static_assert(check_type(boolean, CO_KEY(0x2000, 0, CO_OBJ__N____), true) == CO_DICT_NODEID_TYPE);
static_assert(check_type(variable, CO_KEY(0x2000, 0, CO_OBJ_D_____), true) == CO_DICT_DIRECT_TYPE);
static_assert(check_type(variable, CO_KEY(0x0008, 0, 0), false) == CO_DICT_OK, "a static data type holds nothing");

template <const auto& Od>
bool finds(CO_DICT_FAULT fault, std::uint32_t at) {
  constexpr co::dictionary::Finding finding = co::dictionary::check<Od>();
  return finding.fault == fault && finding.key == at;
}

std::uint32_t sum_of(int value) { return static_cast<std::uint32_t>(value); }

}  // namespace

TEST_CASE("compile-time dictionary: the first of several faults is reported") {
  static constexpr CO_OBJ faulty[] = {
      {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
      {CO_KEY(0x2000, 2, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(7)},
      {CO_KEY(0x2000, 1, CO_OBJ_____RW), nullptr, 0},
  };
  CHECK(finds<faulty>(CO_DICT_DIRECT_ADDRESS, CO_KEY(0x2000, 2, CO_OBJ_____RW)));
}

TEST_CASE("compile-time dictionary: a table in a function is checked") {
  static constexpr CO_OBJ local[] = {{CO_KEY(0x2001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)}};
  CO_OD_CHECK_PART(local);
  CHECK(co::entry<local, 0x2001, 0>() == &local[0]);
}

TEST_CASE("compile-time dictionary: an entry found by the compiler equals that of the run-time search") {
  CO_NODE node = {};
  REQUIRE(CODictInit(&node.Dict, &node, const_cast<CO_OBJ*>(od), sizeof od / sizeof od[0]) == std::size(od) - 1);
  CHECK(node.Dict.Num == 17);
  CHECK(CODictFind(&node.Dict, CO_DEV(0x2100, 1)) == co::entry<od, 0x2100, 1>());
  CHECK(CODictFind(&node.Dict, CO_DEV(0xFFFF, 0xFF)) == co::entry<od, 0xFFFF, 0xFF>());
}

TEST_CASE("CO_DATA: contains the bit pattern that C code reads") {
  std::uintptr_t seen = 0;
  CO_DATA data = (CO_DATA)(&speed);
  std::memcpy(&seen, &data, sizeof seen);
  CHECK(seen == reinterpret_cast<std::uintptr_t>(&speed));
  data = (CO_DATA)(&callback);
  std::memcpy(&seen, &data, sizeof seen);
  CHECK(seen == reinterpret_cast<std::uintptr_t>(&callback));
  data = (CO_DATA)(-1);
  std::memcpy(&seen, &data, sizeof seen);
  CHECK(seen == UINTPTR_MAX);
}

TEST_CASE("CO_DATA: returns the value that firmware has stored, with the usual casts") {
  CO_OBJ obj = {CO_KEY(0x2100, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&speed)};
  speed = 0x12345678;
  CHECK(*(std::uint32_t*)obj.Data == 0x12345678);
  CHECK(*((std::uint32_t*)(obj.Data)) == 0x12345678);
  CHECK(static_cast<const std::uint32_t*>(obj.Data) == &speed);
  CHECK((void*)obj.Data == &speed);
  CHECK(obj.Data == (CO_DATA)(&speed));
  CHECK(obj.Data != 0);
  CHECK((obj.Data ? true : false));

  obj.Data = (CO_DATA)(300);
  CHECK(obj.Data == 300);
  CHECK((std::uint8_t)obj.Data == 44);
  CHECK(static_cast<std::uint16_t>(obj.Data) == 300);
  CHECK((obj.Data & 0xFF) == 44);
  const std::uintptr_t word = obj.Data;
  CHECK(word == 300);
  CHECK(sum_of((int)obj.Data) == 300);

  obj.Data = (CO_DATA)(Answer::yes);
  CHECK((Answer)obj.Data == Answer::yes);
  obj.Data = (CO_DATA)(&callback);
  CHECK(((void (*)())obj.Data == &callback));
  obj.Data = 0;
  CHECK(!obj.Data);
  CHECK((std::uint32_t*)obj.Data == nullptr);
  std::memset(&obj, 0, sizeof obj);
  CHECK(obj.Type == nullptr);
}
