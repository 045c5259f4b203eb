// SPDX-License-Identifier: Apache-2.0
// Reading of an EDS: meaning of values; in the form of CiA 306 and in others that exist.
#include <doctest/doctest.h>

#include "reading.hpp"

using lexican::codict::Access;
using test::meaning;
using test::Reading;

TEST_CASE("EDS: a number with a leading zero is octal, and 8 is no octal digit [306: 4.2]") {
  const Reading eds("octal.eds");
  CHECK(meaning(eds.value(0x2000)) == "10");
  CHECK(meaning(eds.value(0x2001)) == "malformed");
  CHECK(eds.value(0x2001).text == "018");
  CHECK(eds.found() == "30:14 od-value-octal\n37:16 od-value-octal-digit\n");
}

TEST_CASE("EDS: a suffix of C is ignored; a final h means hexadecimal") {
  const Reading eds("number_suffix.eds");
  CHECK(meaning(eds.value(0x2000)) == "1311768467294899695");
  CHECK(meaning(eds.value(0x2001)) == "128");
  CHECK(eds.found() == "30:32 od-value-suffix\n37:18 od-value-suffix\n");
}

TEST_CASE("EDS: a comment after a number or an access type is ignored") {
  const Reading eds("number_comment.eds");
  CHECK(meaning(eds.value(0x2000)) == "1005");
  CHECK(eds.value(0x2000).text == "0x3ED ; prevent homing");
  CHECK(eds.at(0x2001).access.value == Access::rw);
  CHECK(eds.found() == "30:19 od-value-comment\n36:14 od-value-comment\n");
}

TEST_CASE("EDS: an integer may have a decimal point with zeros only") {
  const Reading eds("number_fraction.eds");
  CHECK(meaning(eds.value(0x2000)) == "3");
  CHECK(meaning(eds.value(0x2001)) == "malformed");
  CHECK(eds.found() == "30:15 od-value-fraction\n37:15 od-value-fraction\n");
}

TEST_CASE("EDS: true and false are numbers, other words are not") {
  const Reading eds("number_word.eds");
  CHECK(meaning(eds.value(0x2000)) == "0");
  CHECK(meaning(eds.value(0x2001)) == "1");
  CHECK(meaning(eds.value(0x2002)) == "malformed");
  CHECK(eds.found() == "31:14 od-value-word\n38:14 od-value-word\n45:14 od-value-number\n");
}

TEST_CASE("EDS: a number must fit its data type") {
  const Reading eds("number_range.eds");
  CHECK(meaning(eds.value(0x2000)) == "malformed");
  CHECK(meaning(eds.value(0x2001)) == "malformed");
  CHECK(meaning(eds.value(0x2002)) == "malformed");
  CHECK(meaning(eds.value(0x2003)) == "malformed");
  CHECK(meaning(eds.at(0x2004).high_limit) == "malformed");
  CHECK(eds.found() ==
        "33:14 od-value-range\n40:14 od-value-range\n47:14 od-value-range\n54:14 od-value-range\n"
        "63:11 od-value-range\n");
  CHECK(eds.findings.all()[3].text == "'40000' does not fit INTEGER16 (-32768 to 32767)");
  CHECK(eds.findings.all()[3].hint == "write 0x9C40 for the bit pattern of -25536, or correct the value or data type");
}

TEST_CASE("EDS: a negative number may be written as a bit pattern of the width of its type") {
  const Reading eds("bit_pattern.eds");
  CHECK(meaning(eds.value(0x2000)) == "-1");
  CHECK(meaning(eds.value(0x2001)) == "-128");
  CHECK(meaning(eds.value(0x2002)) == "-2");
  CHECK(meaning(eds.value(0x2003)) == "-32768");
  CHECK(eds.found() == "32:14 od-value-bit-pattern\n39:14 od-value-bit-pattern\n46:14 od-value-bit-pattern\n");
}

TEST_CASE("EDS: $NODEID is added to a number in every notation [306: 4.6.5]") {
  const Reading eds("node_id.eds");
  CHECK(meaning(eds.value(0x2000)) == "$NODEID+384");
  CHECK(meaning(eds.value(0x2001)) == "$NODEID+384");
  CHECK(meaning(eds.value(0x2002)) == "$NODEID+384");
  CHECK(meaning(eds.value(0x2003)) == "$NODEID+0");
  CHECK(meaning(eds.value(0x2004)) == "$NODEID+2147484416");
  CHECK(meaning(eds.value(0x2005)) == "$NODEID+384");
  CHECK(meaning(eds.at(0x2005).low_limit) == "$NODEID+1");
  CHECK(eds.value(0x2000).integer_for(5) == lexican::codict::Integer(0x185));
  CHECK(eds.value(0x2001).text == "0x180+$NODEID");
  CHECK(eds.found() ==
        "41:14 od-value-nodeid-form\n48:14 od-value-nodeid-form\n62:14 od-value-nodeid-form\n"
        "62:32 od-value-comment\n");
}

TEST_CASE("EDS: a REAL is a number with or without a point, or its bit pattern") {
  const Reading eds("real.eds");
  CHECK(meaning(eds.value(0x2000)) == "-1500");
  CHECK(meaning(eds.value(0x2001)) == "7");
  CHECK(meaning(eds.value(0x2002)) == "1.5");
  CHECK(meaning(eds.value(0x2003)) == "0.25");
  CHECK(meaning(eds.value(0x2004)) == "malformed");
  CHECK(eds.found() ==
        "40:14 od-value-real-integer\n47:14 od-value-real-bits\n54:14 od-value-decimal-comma\n"
        "61:14 od-value-number\n");
}

TEST_CASE("EDS: octets are pairs of hexadecimal digits, with or without blanks") {
  const Reading eds("octets.eds");
  CHECK(meaning(eds.value(0x2000)) == "octets 01 02 FF");
  CHECK(meaning(eds.value(0x2001)) == "octets 01 02 FF");
  CHECK(meaning(eds.value(0x2002)) == "malformed");
  CHECK(eds.found() == "45:14 od-value-octets\n");
}

TEST_CASE("EDS: quotes are a part of a string") {
  const Reading eds("quotes.eds");
  CHECK(meaning(eds.value(0x2000)) == "\"\"Hello\"\"");
  CHECK(eds.found() == "29:14 od-value-quotes\n");
}

TEST_CASE("EDS: text after a semicolon in a value is part of it") {
  const Reading eds("semicolon.eds");
  CHECK(eds.at(0x2000).name.text == "A;B=C [D]");
  CHECK(meaning(eds.value(0x2000)) == "\"one; two\"");
  CHECK(eds.found().empty());
}

TEST_CASE("limits and values are compared by their meaning") {
  const Reading eds("limits.eds");
  CHECK(meaning(eds.at(0x2000).high_limit) == "-2147483648");
  CHECK(meaning(eds.at(0x2002).low_limit) == "-32768");
  CHECK(eds.found() ==
        "31:10 od-limit-order\n32:11 od-value-bit-pattern\n39:14 od-limit\n49:10 od-value-bit-pattern\n");
  CHECK(eds.findings.all()[0].text == "LowLimit 0x7FFFFFFF is above HighLimit 0x80000000");
}

TEST_CASE("EDS: a range type of CANFestival gives its base type and limits to objects") {
  const Reading eds("range_type.eds");
  const lexican::codict::DataType& type = data_type_of(eds.device, 0xB2);
  CHECK(type.kind == lexican::codict::TypeKind::unsigned_integer);
  CHECK(type.bits == 16);
  CHECK(meaning(eds.at(0x2040).low_limit) == "1");
  CHECK(meaning(eds.at(0x2040).high_limit) == "500");
  CHECK(meaning(eds.at(0x2041).low_limit) == "10");
  CHECK(eds.found() ==
        "24:2 eds-section-zeros\n29:2 eds-section-zeros\n37:2 eds-section-zeros\n45:2 eds-section-zeros\n"
        "53:2 eds-section-zeros\n69:10 eds-type-own\n77:10 eds-type-own\n79:14 od-limit\n");
}

TEST_CASE("EDS: a type defined by the device is looked up in its object") {
  const Reading eds("type_own.eds");
  CHECK(eds.at(0x2000).data_type.value == 0x40);
  CHECK(data_type_of(eds.device, 0x40).kind == lexican::codict::TypeKind::structure);
  CHECK(data_type_of(eds.device, 0x41).kind == lexican::codict::TypeKind::unknown);
  CHECK(eds.found() == "47:10 eds-type-own\n53:10 eds-type-unknown\n");
}
