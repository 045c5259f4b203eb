// SPDX-License-Identifier: Apache-2.0
#include "co_cfg.h"

#if USE_CSDO  // required by the demo's master
#include <doctest/doctest.h>

#include <string>

#include "client/values.hpp"

namespace {

using lexican::Bytes;

lexican::ValueType type(const char* name) {
  const auto found = lexican::value_type(name);
  REQUIRE(found.has_value());
  return *found;
}

/// Returns the bytes of a value. The text must be valid.
Bytes bytes(const char* type_name, const std::string& text) {
  const lexican::Encoded encoded = lexican::encode(type(type_name), text);
  CAPTURE(text);
  CHECK(encoded.fault == "");
  return encoded.bytes;
}

std::string fault(const char* type_name, const std::string& text) {
  const lexican::Encoded encoded = lexican::encode(type(type_name), text);
  CHECK(encoded.bytes.empty());
  return encoded.fault;
}

/// Returns the text of a value. The bytes must be valid.
std::string shown(const char* type_name, const Bytes& value) {
  const lexican::Shown result = lexican::show(type(type_name), value);
  CHECK(result.fault == "");
  return result.text;
}

}  // namespace

TEST_CASE("demo values: integers are sent with the lowest byte first [301:7.1.4.8]") {
  CHECK(bytes("u8", "255") == Bytes{0xFF});
  CHECK(bytes("u16", "1000") == Bytes{0xE8, 0x03});
  CHECK(bytes("u24", "0x123456") == Bytes{0x56, 0x34, 0x12});
  CHECK(bytes("u32", "0xC10c") == Bytes{0x0C, 0xC1, 0x00, 0x00});
  CHECK(bytes("u64", "18446744073709551615") == Bytes(8, 0xFF));
  CHECK(bytes("i8", "-1") == Bytes{0xFF});
  CHECK(bytes("i16", "-2") == Bytes{0xFE, 0xFF});
  CHECK(bytes("i32", "-0x80") == Bytes{0x80, 0xFF, 0xFF, 0xFF});
  CHECK(bytes("i40", "-2") == Bytes{0xFE, 0xFF, 0xFF, 0xFF, 0xFF});
  CHECK(bytes("i64", "-9223372036854775808") == Bytes{0, 0, 0, 0, 0, 0, 0, 0x80});
}

TEST_CASE("demo values: each integer type accepts its lowest and highest value and refuses the next ones") {
  CHECK(bytes("u8", "0") == Bytes{0});
  CHECK(fault("u8", "256") == "256 is out of range, 0...255");
  CHECK(fault("u8", "-1") == "-1 is out of range, 0...255");
  CHECK(bytes("u8", "-0") == Bytes{0});
  CHECK(bytes("i8", "127") == Bytes{0x7F});
  CHECK(bytes("i8", "-128") == Bytes{0x80});
  CHECK(fault("i8", "128") == "128 is out of range, -128...127");
  CHECK(fault("i8", "-129") == "-129 is out of range, -128...127");
  CHECK(fault("i8", "0xFF") == "0xFF is out of range, -128...127");
  CHECK(fault("u24", "16777216") == "16777216 is out of range, 0...16777215");
  CHECK(bytes("i56", "-36028797018963968") == Bytes{0, 0, 0, 0, 0, 0, 0x80});
  CHECK(fault("i56", "36028797018963968") ==
        "36028797018963968 is out of range, -36028797018963968...36028797018963967");
  CHECK(fault("u64", "18446744073709551616") == "18446744073709551616 is out of range, 0...18446744073709551615");
  CHECK(fault("i64", "9223372036854775808") ==
        "9223372036854775808 is out of range, -9223372036854775808...9223372036854775807");
  CHECK(fault("i64", "-9223372036854775809") ==
        "-9223372036854775809 is out of range, -9223372036854775808...9223372036854775807");
}

TEST_CASE("demo values: a text that is not an integer is refused, also with digits at its begin") {
  for (const char* const text :
       {"", "-", "0x", "12a", "1.5", " 1", "1 ", "--1", "0x-1", "x1", "99999999999999999999x"}) {
    CAPTURE(text);
    CHECK(fault("u32", text) == '\'' + std::string(text) + "' is no integer");
  }
  CHECK(bytes("u8", "010") == Bytes{10});  // not octal
}

TEST_CASE("demo values: reals are IEEE 754 [301:7.1.4.6]") {
  CHECK(bytes("r32", "1") == Bytes{0x00, 0x00, 0x80, 0x3F});
  CHECK(bytes("r32", "-2.5") == Bytes{0x00, 0x00, 0x20, 0xC0});
  CHECK(bytes("r64", "1e0") == Bytes{0, 0, 0, 0, 0, 0, 0xF0, 0x3F});
  CHECK(fault("r32", "1e39") == "1e39 is out of range of this type");
  CHECK(bytes("r64", "1e39").size() == 8);
  CHECK(fault("r64", "1e309") == "1e309 is out of range of this type");
  CHECK(fault("r32", "1,5") == "'1,5' is no number");
  CHECK(fault("r32", "") == "'' is no number");
  CHECK(shown("r32", {0x00, 0x00, 0x20, 0xC0}) == "-2.5");
  CHECK(shown("r32", {0xCD, 0xCC, 0xCC, 0x3D}) == "0.1");
  CHECK(shown("r64", {0x9A, 0x99, 0x99, 0x99, 0x99, 0x99, 0xB9, 0x3F}) == "0.1");
}

TEST_CASE("demo values: booleans, texts and bytes are converted") {
  CHECK(bytes("bool", "1") == Bytes{1});
  CHECK(bytes("bool", "true") == Bytes{1});
  CHECK(bytes("bool", "0") == Bytes{0});
  CHECK(bytes("bool", "false") == Bytes{0});
  CHECK(fault("bool", "2") == "'2' is none of 0, 1, false and true");
  CHECK(bytes("string", "Halt 7") == Bytes{'H', 'a', 'l', 't', ' ', '7'});
  CHECK(bytes("string", std::string("a\0\xFF", 3)) == Bytes{'a', 0, 0xFF});
  CHECK(bytes("bytes", "00 fF7f") == Bytes{0x00, 0xFF, 0x7F});
  CHECK(bytes("domain", "01") == Bytes{0x01});
  CHECK(fault("bytes", "012") == "the number of hex digits is odd, a byte has two");
  CHECK(fault("bytes", "0x01") == "'0x' is no byte, which has two hex digits");
  CHECK(fault("bytes", "-1") == "'-1' is no byte, which has two hex digits");
  CHECK(shown("bool", {0}) == "0");
  CHECK(shown("bool", {0xFF}) == "1");
  CHECK(shown("string", {'a', 0, 0xFF}) == std::string("a\0\xFF", 3));
  CHECK(shown("bytes", {0x00, 0xFF, 0x7F}) == "00 FF 7F");
}

TEST_CASE("demo values: integers are shown in decimal, with their sign") {
  CHECK(shown("u8", {0xFF}) == "255");
  CHECK(shown("i8", {0xFF}) == "-1");
  CHECK(shown("i8", {0x80}) == "-128");
  CHECK(shown("i16", {0xFF, 0x7F}) == "32767");
  CHECK(shown("i24", {0x00, 0x00, 0x80}) == "-8388608");
  CHECK(shown("u32", {0x0C, 0xC1, 0x00, 0x00}) == "49420");
  CHECK(shown("u64", Bytes(8, 0xFF)) == "18446744073709551615");
  CHECK(shown("i64", {0, 0, 0, 0, 0, 0, 0, 0x80}) == "-9223372036854775808");
}

TEST_CASE("demo values: a value with another number of bytes than its type is not shown") {
  CHECK(lexican::show(type("u16"), {1, 2, 3, 4}).fault == "the object has 4 bytes, a value of this type has 2");
  CHECK(lexican::show(type("u16"), {1}).fault == "the object has 1 byte, a value of this type has 2");
  CHECK(lexican::show(type("r64"), {}).fault == "the object has 0 bytes, a value of this type has 8");
}

TEST_CASE("demo values: untyped 1, 2, 4 and 8 bytes are a number, others a hex dump") {
  CHECK(lexican::guess({0x0C}) == "0x0C");
  CHECK(lexican::guess({0xE8, 0x03}) == "0x03E8");
  CHECK(lexican::guess({0x0C, 0xC1, 0x00, 0x00}) == "0x0000C10C");
  CHECK(lexican::guess({1, 2, 3, 4, 5, 6, 7, 0x80}) == "0x8007060504030201");
  CHECK(lexican::guess({}) == "");
  CHECK(lexican::guess({'a', 0x00, 0xFF}) == "00000000  61 00 FF                                         |a..|");
  const std::string alphabet = "ABCDEFGHIJKLMNOPQ";
  CHECK(lexican::guess(Bytes(alphabet.begin(), alphabet.end())) ==
        "00000000  41 42 43 44 45 46 47 48 49 4A 4B 4C 4D 4E 4F 50  |ABCDEFGHIJKLMNOP|\n"
        "00000010  51                                               |Q|");
}

TEST_CASE("demo values: a visible string is text without trailing zeros if it is printable [301:7.1.6]") {
  CHECK(lexican::visible_text({'D', ' ', '1'}) == "D 1");
  CHECK(lexican::visible_text({'1', '.', '2', 0, 0}) == "1.2");
  CHECK(lexican::visible_text({0x20, 0x7E}) == " ~");
  CHECK(lexican::visible_text({'a', 0, 'b'}) == "");
  CHECK(lexican::visible_text({'a', 0x1F}) == "");
  CHECK(lexican::visible_text({'a', 0x7F}) == "");
  CHECK(lexican::visible_text({0, 0}) == "");
  CHECK(lexican::visible_text({}) == "");
}

TEST_CASE("demo values: the types have their names") {
  for (const char* const name : {"u8", "u64", "i8", "i24", "r32", "r64", "bool", "string", "bytes", "domain"}) {
    CAPTURE(name);
    CHECK(lexican::value_type(name).has_value());
  }
  for (const char* const name : {"", "u", "u0", "u12", "u72", "r16", "U8", "int"}) {
    CAPTURE(name);
    CHECK_FALSE(lexican::value_type(name).has_value());
  }
}
#endif
