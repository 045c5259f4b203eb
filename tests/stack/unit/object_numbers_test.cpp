// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "support/entry.hpp"

namespace {

using namespace test;

bool is_little_endian() {
  const std::uint16_t one = 1;
  std::uint8_t first;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

// Returns the low \a width bytes of a number in the byte order of the CPU.
Bytes bytes_of(std::uint64_t number, unsigned width) {
  Bytes bytes(width);
  for (unsigned i = 0; i < width; ++i) {
    bytes[is_little_endian() ? i : width - 1 - i] = static_cast<std::uint8_t>(number >> (8 * i));
  }
  return bytes;
}

std::uint64_t variable_of(const void* variable, unsigned storage) {
  switch (storage) {
    case 1: return *static_cast<const std::uint8_t*>(variable);
    case 2: return *static_cast<const std::uint16_t*>(variable);
    case 4: return *static_cast<const std::uint32_t*>(variable);
    default: return *static_cast<const std::uint64_t*>(variable);
  }
}

struct Kind {
  std::string name;
  const CO_OBJ_TYPE* type;
  std::uint8_t width;
  unsigned storage;
  bool is_signed;
};

const Kind kinds[] = {
    {"UNSIGNED8", CO_TUNSIGNED8, 1, 1, false},   {"INTEGER8", CO_TSIGNED8, 1, 1, true},
    {"UNSIGNED16", CO_TUNSIGNED16, 2, 2, false}, {"INTEGER16", CO_TSIGNED16, 2, 2, true},
    {"UNSIGNED24", CO_TUNSIGNED24, 3, 4, false}, {"INTEGER24", CO_TSIGNED24, 3, 4, true},
    {"UNSIGNED32", CO_TUNSIGNED32, 4, 4, false}, {"INTEGER32", CO_TSIGNED32, 4, 4, true},
    {"UNSIGNED40", CO_TUNSIGNED40, 5, 8, false}, {"INTEGER40", CO_TSIGNED40, 5, 8, true},
    {"UNSIGNED48", CO_TUNSIGNED48, 6, 8, false}, {"INTEGER48", CO_TSIGNED48, 6, 8, true},
    {"UNSIGNED56", CO_TUNSIGNED56, 7, 8, false}, {"INTEGER56", CO_TSIGNED56, 7, 8, true},
    {"UNSIGNED64", CO_TUNSIGNED64, 8, 8, false}, {"INTEGER64", CO_TSIGNED64, 8, 8, true},
    {"REAL32", CO_TREAL32, 4, 4, false},         {"REAL64", CO_TREAL64, 8, 8, false},
};

std::uint64_t masked(std::uint64_t value, unsigned bytes) {
  return bytes == 8 ? value : value & ((std::uint64_t{1} << (8 * bytes)) - 1);
}

// Returns the content of the variable after \a value was written: sign extension fills the bytes that are not on the
// bus.
std::uint64_t stored(const Kind& kind, std::uint64_t value) {
  const std::uint64_t low = masked(value, kind.width);
  const bool negative = kind.is_signed && ((low >> (8 * kind.width - 1)) & 1U) != 0;
  return masked(negative && kind.width < 8 ? low | ~masked(~std::uint64_t{0}, kind.width) : low, kind.storage);
}

constexpr std::uint64_t samples[] = {0,
                                     1,
                                     0x7F,
                                     0x80,
                                     0xFF,
                                     0x0102030405060708,
                                     0x8182838485868788,
                                     0x7FFFFFFFFFFFFFFF,
                                     0x8000000000000000,
                                     0xFFFFFFFFFFFFFFFF,
                                     0x123456};

TEST_CASE("types: numbers of every width are read and written with buffers of any alignment") {
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    alignas(8) std::uint8_t variable[8];
    Entry entry(kind.type, CO_OBJ_____RW, static_cast<void*>(variable));
    CHECK(entry.size() == kind.width);
    CHECK(entry.size(1) == kind.width);
    CHECK(entry.size(100) == kind.width);
    for (const std::uint64_t sample : samples) {
      for (unsigned shift = 0; shift < 8; ++shift) {
        std::uint8_t buffer[24];
        std::memset(buffer, 0xEE, sizeof buffer);
        const Bytes bytes = bytes_of(sample, kind.width);
        std::memcpy(buffer + shift, bytes.data(), kind.width);
        REQUIRE(entry.write(buffer + shift, kind.width) == CO_ERR_NONE);
        CHECK(variable_of(variable, kind.storage) == stored(kind, sample));
        std::memset(buffer, 0xEE, sizeof buffer);
        REQUIRE(entry.read(buffer + 8 + shift, kind.width) == CO_ERR_NONE);
        CHECK(std::memcmp(buffer + 8 + shift, bytes.data(), kind.width) == 0);
        CHECK(buffer[7 + shift] == 0xEE);
        CHECK(buffer[8 + shift + kind.width] == 0xEE);
      }
    }
  }
}

TEST_CASE("types: a width that differs from the object is refused and changes nothing") {
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    alignas(8) std::uint8_t variable[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    Entry entry(kind.type, CO_OBJ_____RW, static_cast<void*>(variable));
    for (std::uint8_t width = 0; width < 12; ++width) {
      if (width == kind.width) continue;
      std::uint8_t buffer[16] = {0xEE, 0xEE};
      CHECK(entry.write(buffer, width) == CO_ERR_BAD_ARG);
      CHECK(entry.read(buffer, width) == CO_ERR_BAD_ARG);
      CHECK(buffer[0] == 0xEE);
    }
    CHECK(variable[0] == 1);
    CHECK(variable[7] == 8);
  }
}

TEST_CASE("types: without a variable the size is 0 and accesses are refused") {
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    Entry entry(kind.type, CO_OBJ_____RW, nullptr);
    std::uint8_t buffer[8] = {};
    CHECK(entry.size() == 0);
    CHECK(entry.read(buffer, kind.width) == CO_ERR_BAD_ARG);
    CHECK(entry.write(buffer, kind.width) == CO_ERR_BAD_ARG);
  }
}

TEST_CASE("types: the value in the entry (flag D) is accessed") {
  for (const Kind& kind : kinds) {
    if (kind.storage > sizeof(std::uintptr_t) || kind.type == CO_TREAL32 || kind.type == CO_TREAL64) continue;
    CAPTURE(kind.name);
    Entry entry(kind.type, CO_OBJ_D___RW, 0);
    CHECK(entry.size() == kind.width);
    for (const std::uint64_t sample : samples) {
      const Bytes bytes = bytes_of(sample, kind.width);
      REQUIRE(entry.write(bytes.data(), kind.width) == CO_ERR_NONE);
      Bytes out(kind.width);
      REQUIRE(entry.read(out.data(), kind.width) == CO_ERR_NONE);
      CHECK(out == bytes);
    }
  }
}

TEST_CASE("types: values given directly in the table are read in any width (flag D)") {
  Entry byte(CO_TUNSIGNED8, CO_OBJ_D___R_, 0xA5);
  std::uint8_t u8 = 0;
  CHECK(byte.read(&u8, 1) == CO_ERR_NONE);
  CHECK(u8 == 0xA5);
  Entry word(CO_TUNSIGNED16, CO_OBJ_D___R_, 0xA5B6);
  std::uint16_t u16 = 0;
  CHECK(word.read(&u16, 2) == CO_ERR_NONE);
  CHECK(u16 == 0xA5B6);
  Entry negative(CO_TSIGNED16, CO_OBJ_D___R_, -2);
  std::int16_t i16 = 0;
  CHECK(negative.read(&i16, 2) == CO_ERR_NONE);
  CHECK(i16 == -2);
}

TEST_CASE("types: values relative to the node-ID are added modulo the width (flag N)") {
  for (const Kind& kind : kinds) {
    if (kind.type == CO_TREAL32 || kind.type == CO_TREAL64) continue;
    CAPTURE(kind.name);
    alignas(8) std::uint8_t variable[8] = {};
    Entry entry(kind.type, CO_OBJ__N__RW, static_cast<void*>(variable));
    Bytes out(kind.width);
    REQUIRE(entry.read(out.data(), kind.width) == CO_ERR_NONE);
    CHECK(out == bytes_of(5, kind.width));
    for (const std::uint64_t sample : samples) {
      const Bytes bytes = bytes_of(sample, kind.width);
      REQUIRE(entry.write(bytes.data(), kind.width) == CO_ERR_NONE);
      CHECK(variable_of(variable, kind.storage) == stored(kind, sample - 5));
      REQUIRE(entry.read(out.data(), kind.width) == CO_ERR_NONE);
      CHECK(out == bytes);
    }
  }
}

TEST_CASE("types: values relative to the node-ID in the entry are accessed (flags D and N)") {
  Entry entry(CO_TUNSIGNED32, CO_OBJ_DN__RW, 0x600);
  std::uint32_t value = 0;
  CHECK(entry.read(&value, 4) == CO_ERR_NONE);
  CHECK(value == 0x605);
  value = 0x1234;
  CHECK(entry.write(&value, 4) == CO_ERR_NONE);
  CHECK(static_cast<std::uintptr_t>(entry.obj.Data) == 0x122F);
  value = 3;
  CHECK(entry.write(&value, 4) == CO_ERR_NONE);
  value = 0;
  CHECK(entry.read(&value, 4) == CO_ERR_NONE);
  CHECK(value == 3);
}

TEST_CASE("types: variables at odd addresses are accessed") {
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    alignas(8) std::uint8_t memory[24];
    for (unsigned shift = 1; shift < 8; ++shift) {
      std::memset(memory, 0xEE, sizeof memory);
      Entry entry(kind.type, CO_OBJ_____RW, static_cast<void*>(memory + 4 + shift));
      const Bytes bytes = bytes_of(0x8182838485868788, kind.width);
      REQUIRE(entry.write(bytes.data(), kind.width) == CO_ERR_NONE);
      Bytes out(kind.width);
      REQUIRE(entry.read(out.data(), kind.width) == CO_ERR_NONE);
      CHECK(out == bytes);
      CHECK(memory[3 + shift] == 0xEE);
      CHECK(memory[4 + shift + kind.storage] == 0xEE);
    }
  }
}

TEST_CASE("types: signed numbers keep their sign, reals their bits") {
  std::int32_t i24 = 0;
  Entry entry(CO_TSIGNED24, CO_OBJ_____RW, &i24);
  const Bytes minus_two = bytes_of(0xFFFFFE, 3);
  CHECK(entry.write(minus_two.data(), 3) == CO_ERR_NONE);
  CHECK(i24 == -2);
  std::int64_t i56 = 0;
  Entry wide(CO_TSIGNED56, CO_OBJ_____RW, &i56);
  const Bytes minus_three = bytes_of(0xFFFFFFFFFFFFFD, 7);
  CHECK(wide.write(minus_three.data(), 7) == CO_ERR_NONE);
  CHECK(i56 == -3);
  float f = 0;
  Entry real(CO_TREAL32, CO_OBJ_____RW, &f);
  const float pi = 3.14159F;
  CHECK(real.write(&pi, 4) == CO_ERR_NONE);
  CHECK(f == pi);
}

TEST_CASE("types: BOOLEAN accepts 0 or 1") {
  std::uint8_t variable = 0;
  Entry entry(CO_TBOOLEAN, CO_OBJ_____RW, &variable);
  CHECK(entry.size() == 1);
  for (unsigned value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    CHECK(entry.write(&byte, 1) == (value <= 1 ? CO_ERR_NONE : CO_ERR_OBJ_RANGE));
  }
  CHECK(variable == 1);
  const std::uint8_t two[2] = {1, 1};
  CHECK(entry.write(two, 2) == CO_ERR_BAD_ARG);
}

TEST_CASE("types: TIME_OF_DAY and TIME_DIFFERENCE have 28 bits of milliseconds and 16 bits of days") {
  CHECK(CO_TTIME_OF_DAY == CO_TTIME_DIFFERENCE);
  CO_TIME_OF_DAY time{0xF2345678, 0xABCD};
  Entry entry(CO_TTIME_OF_DAY, CO_OBJ_____RW, &time);
  CHECK(entry.size() == 6);
  Bytes out(6);
  CHECK(entry.read(out.data(), 6) == CO_ERR_NONE);
  CHECK(out == bytes_of(0xABCD02345678, 6));
  const Bytes in = bytes_of(0x1234FABCDEF0, 6);
  CHECK(entry.write(in.data(), 6) == CO_ERR_NONE);
  CHECK(time.Ms == 0x0ABCDEF0);
  CHECK(time.Days == 0x1234);
  CHECK(entry.read(out.data(), 5) == CO_ERR_BAD_ARG);
  CHECK(entry.write(in.data(), 7) == CO_ERR_BAD_ARG);
  Entry none(CO_TTIME_OF_DAY, CO_OBJ_____RW, nullptr);
  CHECK(none.size() == 0);
  CHECK(none.read(out.data(), 6) == CO_ERR_BAD_ARG);
  CHECK(none.write(in.data(), 6) == CO_ERR_BAD_ARG);
}

}  // namespace
