// SPDX-License-Identifier: Apache-2.0

// The dictionary contains C casts, as in firmware.
#pragma GCC diagnostic ignored "-Wold-style-cast"

#include <doctest/doctest.h>

#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

#include "lexican/object.hpp"

namespace {

enum class Gear : std::int8_t { reverse = -1, neutral = 0, first = 1 };

std::uint8_t u8;
std::int16_t i16;
std::uint32_t u24;
std::int32_t i24;
std::uint32_t u32;
std::uint64_t u40;
std::int64_t i48;
std::uint64_t u56;
std::int64_t i64;
std::uint8_t boolean;
float real32;
double real64;
std::uint32_t relative;
std::uint8_t memory[16];
CO_OBJ_DOM domain{0, sizeof memory, memory};
std::uint16_t stored;

std::uint32_t own_size(CO_OBJ*, CO_NODE*, std::uint32_t) { return 2; }
CO_ERR own_read(CO_OBJ*, CO_NODE*, void*, std::uint32_t) { return CO_ERR_TYPE_RD; }
CO_ERR own_write(CO_OBJ*, CO_NODE*, void* buffer, std::uint32_t) {
  stored = *static_cast<std::uint16_t*>(buffer);
  return CO_ERR_NONE;
}
const CO_OBJ_TYPE own = {own_size, nullptr, own_read, own_write, nullptr};

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x000F0191)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&u8)},
    {CO_KEY(0x2002, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&i16)},
    {CO_KEY(0x2003, 0, CO_OBJ_____RW), CO_TUNSIGNED24, (CO_DATA)(&u24)},
    {CO_KEY(0x2003, 1, CO_OBJ_____RW), CO_TSIGNED24, (CO_DATA)(&i24)},
    {CO_KEY(0x2004, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&u32)},
    {CO_KEY(0x2005, 0, CO_OBJ_____RW), CO_TUNSIGNED40, (CO_DATA)(&u40)},
    {CO_KEY(0x2006, 0, CO_OBJ_____RW), CO_TSIGNED48, (CO_DATA)(&i48)},
    {CO_KEY(0x2007, 0, CO_OBJ_____RW), CO_TUNSIGNED56, (CO_DATA)(&u56)},
    {CO_KEY(0x2008, 0, CO_OBJ_____RW), CO_TSIGNED64, (CO_DATA)(&i64)},
    {CO_KEY(0x2010, 0, CO_OBJ_____RW), CO_TBOOLEAN, (CO_DATA)(&boolean)},
    {CO_KEY(0x2014, 0, CO_OBJ_____RW), CO_TREAL32, (CO_DATA)(&real32)},
    {CO_KEY(0x2018, 0, CO_OBJ_____RW), CO_TREAL64, (CO_DATA)(&real64)},
    {CO_KEY(0x2020, 0, CO_OBJ__N__RW), CO_TUNSIGNED32, (CO_DATA)(&relative)},
    {CO_KEY(0x2030, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain)},
    {CO_KEY(0x2040, 0, CO_OBJ_____RW), &own, (CO_DATA)(&stored)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(od);

// A node that is initialised only as far as the dictionary requires.
struct Node : CO_NODE {
  Node() : CO_NODE{} {
    static constexpr CO_NODE_EXT nothing = {};
    NodeId = 5;
    Ext = &nothing;
    REQUIRE(CODictInit(&Dict, this, const_cast<CO_OBJ*>(od), sizeof od / sizeof od[0]) == std::size(od) - 1);
  }
};

template <class T>
void check_round_trip(CO_NODE& node, std::uint16_t index, T value, std::uint8_t sub = 0) {
  const auto object = co::object<T>(node, index, sub);
  REQUIRE(object.error() == CO_ERR_NONE);
  CHECK(object.set(value) == CO_ERR_NONE);
  const co::Result<T> read = object.get();
  CHECK(read.error() == CO_ERR_NONE);
  CHECK(read.value() == value);
}

}  // namespace

TEST_CASE("typed access: every width and kind of number is read back") {
  Node node;
  check_round_trip<std::uint8_t>(node, 0x2001, 0xA5);
  CHECK(u8 == 0xA5);
  check_round_trip<std::int16_t>(node, 0x2002, -2);
  CHECK(i16 == -2);
  check_round_trip<std::uint32_t>(node, 0x2003, 0xFFEEDD);
  CHECK(u24 == 0xFFEEDD);
  check_round_trip<std::int32_t>(node, 0x2003, -8388608, 1);
  CHECK(i24 == -8388608);
  check_round_trip<std::uint32_t>(node, 0x2004, 0x89ABCDEF);
  CHECK(u32 == 0x89ABCDEF);
  check_round_trip<std::uint64_t>(node, 0x2005, 0xFF22334455);
  CHECK(u40 == 0xFF22334455);
  check_round_trip<std::int64_t>(node, 0x2006, -3);
  CHECK(i48 == -3);
  check_round_trip<std::uint64_t>(node, 0x2007, 0xFFFFFFFFFFFFFF);
  CHECK(u56 == 0xFFFFFFFFFFFFFF);
  check_round_trip<std::int64_t>(node, 0x2008, std::numeric_limits<std::int64_t>::min());
  CHECK(i64 == std::numeric_limits<std::int64_t>::min());
  check_round_trip<float>(node, 0x2014, -1.5F);
  CHECK(real32 == -1.5F);
  check_round_trip<double>(node, 0x2018, 1e300);
  CHECK(real64 == 1e300);
  check_round_trip<bool>(node, 0x2010, true);
  CHECK(boolean == 1);
  check_round_trip<Gear>(node, 0x2001, Gear::reverse);
  CHECK(u8 == 0xFF);
}

TEST_CASE("typed access: a value too large for the object is refused and not stored") {
  Node node;
  u24 = 1;
  CHECK(co::object<std::uint32_t>(node, 0x2003, 0).set(0x1000000) == CO_ERR_OBJ_RANGE);
  CHECK(u24 == 1);
  i24 = 1;
  CHECK(co::object<std::int32_t>(node, 0x2003, 1).set(0x800000) == CO_ERR_OBJ_RANGE);
  CHECK(co::object<std::int32_t>(node, 0x2003, 1).set(-0x800001) == CO_ERR_OBJ_RANGE);
  CHECK(i24 == 1);
  CHECK(co::object<std::int32_t>(node, 0x2003, 1).set(0x7FFFFF) == CO_ERR_NONE);
  CHECK(co::object<std::uint64_t>(node, 0x2005, 0).set(0x10000000000) == CO_ERR_OBJ_RANGE);
}

TEST_CASE("typed access: the length is checked at the lookup") {
  Node node;
  CHECK(co::object<std::uint16_t>(node, 0x2001, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<std::uint8_t>(node, 0x2002, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<std::uint16_t>(node, 0x2003, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<std::uint64_t>(node, 0x2003, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<std::uint64_t>(node, 0x2004, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<std::uint32_t>(node, 0x2005, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<float>(node, 0x2003, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<double>(node, 0x2007, 0).error() == CO_ERR_OBJ_SIZE);
  CHECK(co::object<bool>(node, 0x2002, 0).error() == CO_ERR_OBJ_SIZE);
}

TEST_CASE("typed access: the error of the lookup is returned by every access") {
  Node node;
  const auto missing = co::object<std::uint32_t>(node, 0x2100, 1);
  CHECK_FALSE(static_cast<bool>(missing));
  CHECK(missing.error() == CO_ERR_OBJ_NOT_FOUND);
  CHECK(missing.entry() == nullptr);
  CHECK(missing.get().error() == CO_ERR_OBJ_NOT_FOUND);
  CHECK(missing.set(1) == CO_ERR_OBJ_NOT_FOUND);
  const auto wrong = co::object<std::uint8_t>(node, 0x2004, 0);
  u32 = 7;
  CHECK(wrong.get().error() == CO_ERR_OBJ_SIZE);
  CHECK(wrong.set(1) == CO_ERR_OBJ_SIZE);
  CHECK(u32 == 7);
}

TEST_CASE("typed access: a result contains a value or an error") {
  Node node;
  u32 = 9;
  const auto good = co::object<std::uint32_t>(node, 0x2004, 0).get();
  CHECK(static_cast<bool>(good));
  CHECK(good.value_or(1) == 9);
  const auto bad = co::object<std::uint32_t>(node, 0x2FFF, 0).get();
  CHECK_FALSE(static_cast<bool>(bad));
  CHECK(bad.value() == 0);
  CHECK(bad.value_or(1) == 1);
}

TEST_CASE("typed access: errors of type functions are returned to the caller") {
  Node node;
  const auto object = co::object<std::uint16_t>(node, 0x2040, 0);
  CHECK(object.get().error() == CO_ERR_TYPE_RD);
  CHECK(object.set(0x1234) == CO_ERR_NONE);
  CHECK(stored == 0x1234);
}

TEST_CASE("typed access: values relative to the node-ID have it added") {
  Node node;
  relative = 0x600;
  const auto object = co::object<std::uint32_t>(node, 0x2020, 0);
  CHECK(object.get().value() == 0x605);
  CHECK(object.set(0x685) == CO_ERR_NONE);
  CHECK(relative == 0x680);
}

TEST_CASE("typed access: any byte except 0 is true") {
  Node node;
  const auto object = co::object<bool>(node, 0x2010, 0);
  boolean = 2;
  CHECK(object.get().value());
  boolean = 0;
  CHECK_FALSE(object.get().value());
}

TEST_CASE("typed access: the type of an object with a constant key is determined by the compiler") {
  Node node;
  static_assert(std::is_same_v<decltype(co::object<od, 0x2001, 0>(node)), co::Object<std::uint8_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2002, 0>(node)), co::Object<std::uint16_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2003, 0>(node)), co::Object<std::uint32_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2003, 1>(node)), co::Object<std::int32_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2006, 0>(node)), co::Object<std::int64_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2007, 0>(node)), co::Object<std::uint64_t>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2010, 0>(node)), co::Object<bool>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2014, 0>(node)), co::Object<float>>);
  static_assert(std::is_same_v<decltype(co::object<od, 0x2018, 0>(node)), co::Object<double>>);

  i16 = -7;
  CHECK(co::object<od, 0x2002, 0, std::int16_t>(node).get().value() == -7);
  CHECK(co::object<od, 0x2003, 1>(node).set(-1) == CO_ERR_NONE);
  CHECK(i24 == -1);
  CHECK(co::object<od, 0x2001, 0, Gear>(node).set(Gear::first) == CO_ERR_NONE);
  CHECK(u8 == 1);
  CHECK(co::object<od, 0x1000, 0>(node).get().value() == 0x000F0191);
}

TEST_CASE("typed access: the length of an application-defined type is read from Size") {
  Node node;
  const auto fitting = co::object<od, 0x2040, 0, std::uint16_t>(node);
  CHECK(fitting.set(0x4321) == CO_ERR_NONE);
  CHECK(stored == 0x4321);
  const auto other = co::object<od, 0x2040, 0, std::uint32_t>(node);
  CHECK(other.error() == CO_ERR_OBJ_SIZE);
}
