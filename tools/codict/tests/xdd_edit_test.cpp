// SPDX-License-Identifier: Apache-2.0
// Edits of XML descriptions change only the intended bytes.
#include <doctest/doctest.h>

#include <string>

#include "text/edit.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::XmlReading;

namespace {

std::string with(const XmlReading& reading, const Edits& edits) {
  return edits.applied_to(reading.document.source().bytes());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("XDD edit: without a change the bytes are the same") {
  const std::string bytes = test::bytes_of_fixture("device10.xdd");
  CHECK(with(XmlReading(bytes), Edits()) == bytes);
}

TEST_CASE("XDD edit: a value is replaced at its place with its quotes and blanks") {
  const std::string bytes = test::xdd_with(
      "<CANopenObject  index = '2000' name='a'\n objectType=\"7\" dataType=\"05\" accessType=\"rw\" defaultValue = ' 1 "
      "' />");
  const XmlReading reading(bytes);
  Edits edits;
  REQUIRE(reading.document.set_text(reading.at(0x2000).default_value.span, "0x20", edits));
  CHECK(with(reading, edits) == replaced(bytes, "' 1 '", "' 0x20 '"));
}

TEST_CASE("XDD edit: quotes and line ends of an attribute are kept, and a text of equal meaning is not changed") {
  const std::string bytes = test::xdd_with("<CANopenObject index='2000' name='a' denotation='&#98;'/>");
  const XmlReading reading(bytes);
  Edits edits;
  REQUIRE(reading.document.set_text(reading.at(0x2000).denotation->span, "b", edits));
  CHECK(edits.is_empty());
  REQUIRE(reading.document.set_text(reading.at(0x2000).name.span, "it's\n\"it\"", edits));
  CHECK(XmlReading(with(reading, edits)).at(0x2000).name.text == "it's\n\"it\"");
}

TEST_CASE("XDD edit: the value of a parameter and the text of a label are changed") {
  const std::string bytes = test::bytes_of_fixture("device10.xdd");
  const XmlReading reading(bytes);
  const Entry& mode = reading.at(0x2000);
  Edits edits;
  REQUIRE(reading.document.set_text(mode.actual_value->span, "0", edits));
  REQUIRE(reading.document.set_text(mode.texts->labels[1].text.span, "Art & <Weise>", edits));
  const std::string expected = replaced(replaced(bytes, "<actualValue value=\"1\"", "<actualValue value=\"0\""),
                                        ">Betriebsart<", ">Art &amp; &lt;Weise&gt;<");
  CHECK(with(reading, edits) == expected);
  CHECK(XmlReading(expected).at(0x2000).texts->labels[1].text.text == "Art & <Weise>");
}

TEST_CASE("XDD edit: every text of an object can be written back at its place") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Entry& mode = reading.at(0x2000);
  for (const Text* text : std::initializer_list<const Text*>{
           &mode.name, &mode.object_code, &mode.data_type, &mode.access, &mode.pdo_mapping, &mode.default_value,
           &*mode.actual_value, &*mode.substitute_value, &*mode.low_limit, &*mode.denotation, &*mode.parameter_id,
           &*mode.support, &*mode.access_list, &mode.node->storage_group, &mode.unit->uri,
           &mode.allowed->values[1].value}) {
    CHECK(reading.raw(text->span) == text->text);
    CHECK_FALSE(text->is_empty());
  }
  CHECK(reading.raw(mode.span).substr(0, 29) == "<CANopenObject index=\"2000\" n");
}

TEST_CASE("XDD edit: a new attribute is the last one of its tag, a new element the last child") {
  const std::string bytes =
      "<x:ISO15745ProfileContainer xmlns:x=\"http://www.canopen.org/xml/1.1\"><x:ISO15745Profile><ProfileBody>"
      "<x:ApplicationProcess><x:parameterList>\n"
      "  <x:parameter uniqueID=\"P\">\n    <UINT/>\n  </x:parameter></x:parameterList></x:ApplicationProcess>"
      "<ApplicationLayers><x:CANopenObjectList>"
      "<CANopenObject index=\"2000\" name=\"a\" objectType=\"7\" uniqueIDRef=\"P\" />"
      "</x:CANopenObjectList></ApplicationLayers></ProfileBody></x:ISO15745Profile></x:ISO15745ProfileContainer>";
  const XmlReading reading(bytes);
  const Entry& entry = reading.at(0x2000);
  Edits edits;
  REQUIRE(reading.document.add_attribute(entry.span.begin, "PDOmapping", "TPDO", edits));
  REQUIRE(reading.document.add_element(entry.parameter_extent, "defaultValue", {{"value", "7"}}, edits));
  const std::string expected = replaced(replaced(bytes, "\"P\" />", "\"P\" PDOmapping=\"TPDO\" />"), "<UINT/>",
                                        "<UINT/>\n    <x:defaultValue value=\"7\"/>");
  CHECK(with(reading, edits) == expected);
  CHECK(XmlReading(expected).at(0x2000).default_value.text == "7");
}

TEST_CASE("XDD edit: a text that the encoding or XML cannot represent is refused") {
  const std::string bytes =
      "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n" + test::xdd_with(
                                                                "<CANopenObject index=\"2000\" name=\"Gr\xF6\xDF"
                                                                "e\" objectType=\"7\"/>");
  const XmlReading reading(bytes);
  CHECK(reading.at(0x2000).name.text ==
        "Gr\xC3\xB6\xC3\x9F"
        "e");
  Edits edits;
  CHECK(reading.document.set_text(reading.at(0x2000).name.span, "\xC3\xA4", edits));
  CHECK_FALSE(reading.document.set_text(reading.at(0x2000).name.span, "\xD0\x96", edits));
  CHECK_FALSE(reading.document.set_text(reading.at(0x2000).name.span, std::string("\x01", 1), edits));
  CHECK(with(reading, edits) == replaced(bytes,
                                         "Gr\xF6\xDF"
                                         "e",
                                         "\xE4"));
}
