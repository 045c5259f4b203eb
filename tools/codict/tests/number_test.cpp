// SPDX-License-Identifier: Apache-2.0
// Notations of numbers in descriptions. [306: 4.2]
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "text/number.hpp"

using namespace lexican::codict;

namespace {

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

NumberFault fault_of(std::string_view text) { return parse_integer(text).fault; }

}  // namespace

TEST_CASE("an integer is decimal, hexadecimal, or octal with a leading zero") {
  CHECK(parse_integer("0").value == Integer(0));
  CHECK(parse_integer("0").base == Base::decimal);
  CHECK(parse_integer("10").value == Integer(10));
  CHECK(parse_integer("0x1aF").value == Integer(0x1AF));
  CHECK(parse_integer("0X10").value == Integer(16));
  CHECK(parse_integer("012").value == Integer(10));
  CHECK(parse_integer("012").base == Base::octal);
  CHECK(parse_integer("-5").value == Integer(5, true));
  CHECK(parse_integer("+5").value == Integer(5));
  CHECK(parse_integer("-0x8000").value == Integer(0x8000, true));
  CHECK(parse_integer("0xFFFFFFFFFFFFFFFF").value == Integer(largest));
}

TEST_CASE("the fault of an invalid integer and its position are returned") {
  CHECK(fault_of("") == NumberFault::empty);
  CHECK(fault_of("speed") == NumberFault::no_number);
  CHECK(fault_of("-") == NumberFault::no_number);
  CHECK(fault_of("0x") == NumberFault::no_number);
  CHECK(fault_of("--5") == NumberFault::no_number);
  CHECK(fault_of("+-5") == NumberFault::no_number);
  CHECK(fault_of("0x-5") == NumberFault::no_number);
  CHECK(fault_of("018") == NumberFault::octal_digit);
  CHECK(fault_of("18446744073709551616") == NumberFault::too_large);
  CHECK(fault_of("10ul") == NumberFault::suffix);
  CHECK(fault_of("10 ;ten") == NumberFault::comment);
  CHECK(fault_of("10 # ten") == NumberFault::comment);
  CHECK(fault_of("10 // ten") == NumberFault::comment);
  CHECK(fault_of("10;ten") == NumberFault::no_number);
  CHECK(fault_of("10 20") == NumberFault::no_number);
  CHECK(fault_of("3.5") == NumberFault::fraction);
  CHECK(fault_of("3.0") == NumberFault::zero_fraction);
  CHECK(fault_of("3.") == NumberFault::no_number);
  CHECK(fault_of("False") == NumberFault::word);
  CHECK(parse_integer("12x4").fault_at == 2);
  CHECK(parse_integer("0x12y").fault_at == 4);
}

TEST_CASE("numbers are compared by value, not by bits") {
  CHECK(Integer(1, true) < Integer(0));
  CHECK(Integer(2, true) < Integer(1, true));
  CHECK_FALSE(Integer(largest) < Integer(1, true));
  CHECK(Integer(0, true) == Integer(0));
  CHECK(Integer(1, true).bits() == largest);
}

TEST_CASE("the range of a number depends on width and sign") {
  CHECK(fits_unsigned(255, 8));
  CHECK_FALSE(fits_unsigned(256, 8));
  CHECK_FALSE(fits_unsigned(Integer(1, true), 8));
  CHECK(fits_signed(127, 8));
  CHECK_FALSE(fits_signed(128, 8));
  CHECK(fits_signed(Integer(128, true), 8));
  CHECK_FALSE(fits_signed(Integer(129, true), 8));
  CHECK(fits_unsigned(largest, 64));
  CHECK(fits_signed(Integer(std::uint64_t{1} << 63, true), 64));
  CHECK(sign_extended(0xFFFFFE, 24) == Integer(2, true));
  CHECK(sign_extended(0x7F, 8) == Integer(127));
  CHECK(sign_extended(std::uint64_t{1} << 63, 64) == Integer(std::uint64_t{1} << 63, true));
}

TEST_CASE("a formula contains the node-ID and an addend") {
  CHECK(parse_formula("$NODEID").has_node_id);
  CHECK(parse_formula("$NODEID+1+0x10").number.value == Integer(17));
  CHECK(parse_formula("$NODEID+1").is_standard);
  CHECK_FALSE(parse_formula("$NODEID +1").is_standard);
  CHECK_FALSE(parse_formula("1+$NODEID").is_standard);
  CHECK(parse_formula("1+$NODEID").has_node_id);
  CHECK_FALSE(parse_formula("$nodeid+1").is_standard);
  CHECK_FALSE(parse_formula("5").has_node_id);
  CHECK(parse_formula("$NODEID+").number.fault == NumberFault::empty);
  CHECK(parse_formula("$NODEID-1").number.fault == NumberFault::no_number);
  CHECK(parse_formula("$NODEIDX").number.fault == NumberFault::no_number);
  CHECK(parse_formula("$NODE+1").number.fault == NumberFault::no_number);
  CHECK(parse_formula("$NODEID+$NODEID").number.fault == NumberFault::no_number);
  CHECK(parse_formula("$NODEID+5 ; five").number.fault == NumberFault::comment);
  CHECK(parse_formula("$NODEID ; none + none").number.fault == NumberFault::comment);
  CHECK(parse_formula("$NODEID+0xFFFFFFFFFFFFFFFF+1").number.fault == NumberFault::too_large);
}

TEST_CASE("a real is decimal or a bit pattern") {
  CHECK(parse_real("1.5", 32).value == doctest::Approx(1.5));
  CHECK(parse_real("-1e-3", 64).value == doctest::Approx(-0.001));
  CHECK(parse_real("+2.5", 64).form == RealForm::decimal);
  CHECK(parse_real("2", 64).form == RealForm::integer);
  CHECK(parse_real("0x40490FDB", 32).value == doctest::Approx(3.14159274));
  CHECK(parse_real("0x400921FB54442D18", 64).value == doctest::Approx(3.14159265358979));
  CHECK(parse_real("0x100000000", 32).form == RealForm::no_number);
  CHECK(parse_real("0,5", 64).form == RealForm::decimal_comma);
  CHECK(parse_real("1e39", 32).form == RealForm::no_number);
  CHECK(parse_real("1e39", 64).form == RealForm::decimal);
  CHECK(parse_real("1e999", 64).form == RealForm::no_number);
  CHECK(parse_real("1.5f", 32).form == RealForm::no_number);
  CHECK(parse_real("", 32).form == RealForm::no_number);
  CHECK(parse_real("1,2,3", 32).form == RealForm::no_number);
}

TEST_CASE("hexadecimal digits with other characters between them are refused") {
  std::uint64_t value = 0;
  CHECK(parse_hex("1a00", value));
  CHECK(value == 0x1A00);
  CHECK_FALSE(parse_hex("", value));
  CHECK_FALSE(parse_hex("0x10", value));
  CHECK_FALSE(parse_hex("-1", value));
  CHECK_FALSE(parse_hex("10 ", value));
  CHECK_FALSE(parse_hex("10000000000000000", value));
}
