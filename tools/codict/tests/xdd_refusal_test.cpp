// SPDX-License-Identifier: Apache-2.0
// Files that are no XML description of a CANopen device are refused, with one message that names their kind. Hostile
// files do not harm the reader.
#include <doctest/doctest.h>

#include <string>

#include "xdd_reading.hpp"

using test::xdd_with;
using test::xml_refusal;
using test::XmlReading;

namespace {

bool says(const std::string& why, const char* word) { return why.find(word) != std::string::npos; }

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t n = 0; n < times; ++n) {
    result += text;
  }
  return result;
}

}  // namespace

TEST_CASE("no XDD: files that are not XML or not text are refused") {
  CHECK(says(xml_refusal(""), "empty"));
  CHECK(says(xml_refusal("\xEF\xBB\xBF \n"), "empty"));
  CHECK(says(xml_refusal("[FileInfo]\n"), "no XML"));
  CHECK(says(xml_refusal(std::string("<\0a\0", 4)), "NUL byte at 1:2 (offset 1)"));
  CHECK(says(xml_refusal(std::string("\xFF\xFE<\0a\0>\0", 8)), "UTF-16"));
  CHECK(says(xml_refusal("<!-- nothing else -->"), "no XML element"));
}

TEST_CASE("no XDD: constraints of an FPGA design with the suffix of an XDC are refused") {
  CHECK(says(xml_refusal("# clock\nset_property PACKAGE_PIN F19 [get_ports reset]\n"), "FPGA"));
}

TEST_CASE("no XDD: POWERLINK is refused by its namespace, its technology or the type of its body") {
  CHECK(says(xml_refusal("<ISO15745ProfileContainer xmlns=\"http://www.ethernet-powerlink.org\"/>"), "POWERLINK"));
  CHECK(says(xml_refusal("<ISO15745ProfileContainer><ProfileTechnology>Powerlink</ProfileTechnology>"
                         "</ISO15745ProfileContainer>"),
             "POWERLINK"));
  CHECK(
      xml_refusal("<ISO15745ProfileContainer><productName>POWERLINK</productName></ISO15745ProfileContainer>").empty());
}

TEST_CASE("no XDD: other XML is refused") {
  CHECK(says(xml_refusal("<EtherCATInfo/>"), "EtherCAT"));
  CHECK(says(xml_refusal("<note/>"), "<note>"));
}

TEST_CASE("no XDD: a million nested elements are refused") {
  const std::string deep = repeated("<a>", 1000000);
  CHECK(says(xml_refusal(deep), "levels"));
  CHECK(says(xml_refusal(deep + repeated("</a>", 1000000)), "levels"));
  CHECK(says(xml_refusal(xdd_with(repeated("<a>", 100) + repeated("</a>", 100))), "levels"));
}

TEST_CASE("XDD: entities of a document type are not expanded, and no file is read for them") {
  const std::string bomb =
      "<!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">"
      "<!ENTITY f SYSTEM \"file:///etc/passwd\">]>\n" +
      xdd_with("<CANopenObject index=\"2000\" name=\"&b;&f;\" objectType=\"7\" dataType=\"05\" accessType=\"ro\"/>");
  CHECK(xml_refusal(bomb).empty());
  const XmlReading reading(bomb);
  CHECK(reading.at(0x2000).name.text == "&b;&f;");
  CHECK(reading.has("xdd-doctype"));
}

TEST_CASE("XDD: malformed XML is read up to the fault, which is reported with its place") {
  const std::string whole =
      xdd_with("<CANopenObject index=\"2000\" name=\"a\" objectType=\"7\" dataType=\"05\" accessType=\"ro\"/>");
  const XmlReading reading(whole.substr(0, whole.find("</CANopenObjectList>")) + "\n<oops");
  CHECK(reading.at(0x2000).name.text == "a");
  CHECK(reading.has("xdd-syntax"));
}

TEST_CASE("XDD: a large parameter with many references is read once") {
  std::string objects;
  for (unsigned n = 0x2000; n < 0x2200; ++n) {
    constexpr const char* digits = "0123456789ABCDEF";
    const std::string index = {digits[n >> 12], digits[n >> 8 & 15], digits[n >> 4 & 15], digits[n & 15]};
    objects += "<CANopenObject index=\"" + index + "\" name=\"n\" objectType=\"7\" uniqueIDRef=\"P\"/>";
  }
  const std::string large(300000, 'x');
  const XmlReading reading(xdd_with(objects, "<parameter uniqueID=\"P\" access=\"read\"><label lang=\"en\">" + large +
                                                 "</label><UINT/></parameter>"));
  CHECK(reading.device.objects.size() == 0x200);
  CHECK(reading.has("xdd-copies"));
}
