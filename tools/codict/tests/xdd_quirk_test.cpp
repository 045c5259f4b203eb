// SPDX-License-Identifier: Apache-2.0
// Deviations from CiA 311 are read, and reported as findings.
#include <doctest/doctest.h>

#include <string>

#include "reading.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::xdd_with;
using test::XmlReading;

namespace {

const std::string variable = " name=\"a\" objectType=\"7\" dataType=\"05\" accessType=\"rw\"";

XmlReading objects(const std::string& text) { return XmlReading(xdd_with(text)); }

std::string object(const std::string& attributes) { return "<CANopenObject " + attributes + "/>"; }

}  // namespace

TEST_CASE("XDD quirk: the parameter overrides the object; other values of the object are kept") {
  const XmlReading reading = test::fixture_xml("foreign_namespace.xml");
  const Entry& value = reading.at(0x2000);
  CHECK(value.access.value == Access::ro);
  CHECK(value.data_type.value == 7);
  CHECK(value.allowed->ranges.size() == 1);
  CHECK(value.others.size() == 2);
  CHECK(value.others.at(0).name == "@highLimit");  // different notation of the same value: no finding
  CHECK(value.others.at(1).text.text == "rw");
  CHECK(reading.findings.count(Severity::error) == 0);
  CHECK(reading.found() ==
        "3 xdd-namespace\n8 xdd-hex-digits\n8 xdd-parameter-differs\n8 xdd-parameter-differs\n12 xdd-bit-rate\n"
        "12 xdd-bit-rate\n12 xdd-bit-rate\n22 xdd-order\n24 xdd-order\n26 xdd-unknown\n");
}

TEST_CASE("XDD quirk: dataType overrides BITSTRING") {
  const XmlReading reading = test::fixture_xml("foreign_namespace.xml");
  CHECK(reading.at(0x2001).data_type.value == 0x0C);
  CHECK(reading.at(0x2001).name.text == "Time");  // label of the parameter
  CHECK_FALSE(reading.at(0x2001).name.is_given);
}

TEST_CASE("XDD quirk: an unknown element is kept with its content") {
  const XmlReading reading = test::fixture_xml("foreign_namespace.xml");
  const OpaquePart& own = reading.at(0x2001).others.at(0);
  CHECK(own.name == "own");
  CHECK(own.children.at(0).text.text == "text");
  CHECK(own.children.at(0).children.at(0).name == "@a");
}

TEST_CASE("XDD quirk: bit rates without unit, in bit/s and missing ones are read") {
  const XmlReading reading = test::fixture_xml("foreign_namespace.xml");
  REQUIRE(reading.device.features.bit_rates.size() == 3);
  CHECK(reading.device.features.bit_rates[0].kbit == 125);
  CHECK(reading.device.features.bit_rates[1].kbit == 500);
  CHECK_FALSE(reading.device.features.bit_rates[2].supported.value);
}

TEST_CASE("XDD quirk: an invalid and a duplicate index are reported") {
  const XmlReading reading =
      objects(object("index=\"20G0\"" + variable) + "\n" + object("index=\"2000\"" + variable) + "\n" +
              object("index=\"2000\" name=\"b\" objectType=\"7\"") + "\n" + object("name=\"none\""));
  CHECK(reading.device.objects.size() == 1);
  CHECK(reading.at(0x2000).name.text == "a");
  CHECK(reading.found().substr(0, 44) == "2 xdd-index\n4 xdd-duplicate-object\n5 xdd-ind");
  CHECK(reading.device.others.back().children.size() == 3);
}

TEST_CASE("XDD quirk: sub-objects out of order, duplicate and without a number are read") {
  const XmlReading reading = objects(
      "<CANopenObject index=\"2000\" name=\"r\" objectType=\"9\" subNumber=\"2\">\n"
      "<CANopenSubObject subIndex=\"01\"" +
      variable +
      "/>\n"
      "<CANopenSubObject subIndex=\"0\"" +
      variable +
      "/>\n"
      "<CANopenSubObject subIndex=\"01\"" +
      variable +
      "/>\n"
      "<CANopenSubObject" +
      variable + "/>\n</CANopenObject>");
  CHECK(reading.device.find(0x2000)->subs.size() == 2);
  CHECK(reading.device.find(0x2000)->subs[0].sub_index == 0);
  CHECK(reading.device.find(0x2000)->others.size() == 2);
  CHECK(reading.found() == "4 xdd-hex-digits\n5 xdd-duplicate-object\n6 xdd-index\n");
}

TEST_CASE("XDD quirk: a missing, unknown or contradicting objectType is reported") {
  const std::string sub = "<CANopenSubObject subIndex=\"00\"" + variable + "/></CANopenObject>\n";
  const XmlReading reading =
      objects("<CANopenObject index=\"2000\" name=\"r\">" + sub +
              "<CANopenObject index=\"2001\" name=\"r\" objectType=\"7\" dataType=\"05\" "
              "accessType=\"ro\">" +
              sub + object("index=\"2002\" name=\"x\" objectType=\"77\" dataType=\"05\" accessType=\"ro\""));
  CHECK(reading.device.find(0x2000)->object_code.value == ObjectCode::record);
  CHECK(reading.found() == "2 xdd-object-type-missing\n3 xdd-object-type\n4 xdd-object-type\n");
}

TEST_CASE("XDD quirk: other words for access and PDO mapping are read") {
  const XmlReading reading = objects(
      object("index=\"2000\" name=\"a\" objectType=\"7\" dataType=\"05\" accessType=\"RO\" PDOmapping=\"Optional\"") +
      "\n" +
      object("index=\"2001\" name=\"a\" objectType=\"7\" dataType=\"05\" accessType=\"readWrite\" PDOmapping=\"1\"") +
      "\n" + object("index=\"2002\" name=\"a\" objectType=\"7\" dataType=\"05\" accessType=\"both\"") + "\n" +
      object("index=\"2003\" name=\"a\" objectType=\"7\" dataType=\"05\""));
  CHECK(reading.at(0x2000).access.value == Access::ro);
  CHECK(reading.at(0x2000).pdo_mapping.value == PdoMapping::optional);
  CHECK(reading.at(0x2001).access.value == Access::rw);
  CHECK(reading.at(0x2001).pdo_mapping.value == PdoMapping::optional);
  CHECK(reading.found() ==
        "2 xdd-access-case\n2 xdd-pdo-mapping\n3 xdd-access-case\n3 xdd-pdo-mapping\n4 xdd-access-unknown\n"
        "5 xdd-access-missing\n");
}

TEST_CASE("XDD quirk: a missing and an invalid data type are reported; one with 0x is read") {
  const XmlReading reading =
      objects(object("index=\"2000\" name=\"a\" objectType=\"7\" accessType=\"ro\"") + "\n" +
              object("index=\"2001\" name=\"a\" objectType=\"7\" dataType=\"word\" accessType=\"ro\"") + "\n" +
              object("index=\"2002\" name=\"a\" objectType=\"7\" dataType=\"zz\" accessType=\"ro\"") + "\n" +
              object("index=\"2003\" name=\"a\" objectType=\"7\" dataType=\"0x0007\" accessType=\"ro\""));
  CHECK(reading.at(0x2001).data_type.value == 6);
  CHECK(reading.at(0x2003).data_type.value == 7);
  CHECK(reading.found() == "2 xdd-type-missing\n4 xdd-type-missing\n4 xdd-type-unknown\n");
}

TEST_CASE("XDD quirk: dangling references and duplicate ids are reported") {
  const XmlReading reading(
      xdd_with(object("index=\"2000\" uniqueIDRef=\"Q\"" + variable),
               "<parameter uniqueID=\"P\" templateIDRef=\"T\"><dataTypeIDRef uniqueIDRef=\"N\"/></parameter>\n"
               "<parameter uniqueID=\"P\"><UINT/></parameter>"));
  CHECK(reading.found() ==
        "2 xdd-parameter-unused\n2 xdd-reference\n2 xdd-reference\n3 xdd-duplicate-id\n3 xdd-parameter-unused\n5 "
        "xdd-reference\n");
  CHECK(reading.device.parameters.size() == 2);
}

TEST_CASE("XDD quirk: duplicate and unknown attributes and unexpected text are reported") {
  const XmlReading reading =
      objects("<CANopenObject index=\"2000\" own=\"x\"" + variable + " name=\"b\">stray</CANopenObject>");
  CHECK(reading.at(0x2000).name.text == "a");
  CHECK(reading.found() == "2 xdd-unknown\n2 xdd-duplicate\n2 xdd-unknown\n");
  REQUIRE(reading.at(0x2000).others.size() == 3);
  CHECK(reading.at(0x2000).others[2].text.text == "stray");
}

TEST_CASE("XDD quirk: properties with an invalid value are reported") {
  const XmlReading reading(xdd_with(object("index=\"2000\" name=\"a\" objectType=\"7\" uniqueIDRef=\"P\""),
                                    "<parameter uniqueID=\"P\" access=\"read\"><UINT/>\n"
                                    "<property name=\"CO_accessSRDO\" value=\"some\"/>\n"
                                    "<property name=\"CO_stringLengthMin\" value=\"long\"/>\n"
                                    "<property name=\"CO_disabled\" value=\"maybe\"/>\n"
                                    "<property name=\"CO_storageGroup\" value=\"12\"/></parameter>"));
  CHECK(reading.found() == "3 xdd-property\n4 xdd-property\n5 xdd-boolean\n");
  CHECK(reading.at(0x2000).node->storage_group.value == "12");
}

TEST_CASE("XDD: a property with the prefix of CANopenNode is one of its properties") {
  const auto found = [](const std::string& name) {
    return test::XmlReading(
        test::xdd_with("<CANopenObject index=\"2000\" name=\"x\" objectType=\"7\" dataType=\"05\" "
                       "accessType=\"rw\" uniqueIDRef=\"P\"/>",
                       "<parameter uniqueID=\"P\" access=\"readWrite\"><USINT/><property name=\"" + name +
                           "\" value=\"RAM\"/></parameter>"));
  };
  const test::XmlReading slip = found("CO_storageGruop");
  REQUIRE(slip.has("xdd-property"));
  CHECK(slip.findings.all().front().hint == "did you mean CO_storageGroup?");
  CHECK_FALSE(found("CO_storageGroup").has("xdd-property"));
  CHECK_FALSE(found("Own").has("xdd-property"));
}

TEST_CASE("XDD quirk: an invalid dummy is reported") {
  const XmlReading reading(xdd_with("", "", "<dummyUsage>\n<dummy entry=\"Dummy0005\"/><dummy/></dummyUsage>"));
  CHECK(reading.device.dummies.empty());
  CHECK(reading.findings.all().size() == 2);
  CHECK(reading.has("xdd-dummy"));
}

TEST_CASE("XDD quirk: counts of objects are checked") {
  std::string bytes = xdd_with(object("index=\"2000\"" + variable));
  bytes.insert(bytes.find("CANopenObjectList") + 17, " mandatoryObjects=\"3\" manufacturerObjects=\"1\"");
  CHECK(XmlReading(bytes).found() == "1 xdd-list-count\n");
}

TEST_CASE("XDD quirk: values are parsed like those of an EDS; true and false are words of IEC") {
  const XmlReading reading = objects(
      object("index=\"2000\" name=\"a\" objectType=\"7\" dataType=\"01\" accessType=\"ro\" defaultValue=\"true\"") +
      "\n" +
      object("index=\"2001\" name=\"a\" objectType=\"7\" dataType=\"02\" accessType=\"ro\" defaultValue=\"0xFF\"") +
      "\n" +
      object("index=\"2002\" name=\"a\" objectType=\"7\" dataType=\"08\" accessType=\"ro\" defaultValue=\"1,5\""));
  CHECK(meaning(reading.at(0x2000).default_value) == "1");
  CHECK(meaning(reading.at(0x2001).default_value) == "-1");
  CHECK(meaning(reading.at(0x2002).default_value) == "1.5");
  CHECK(reading.found() == "3 od-value-bit-pattern\n4 od-value-decimal-comma\n");
}

TEST_CASE("XDD quirk: character references, CDATA and other line ends are read") {
  const XmlReading reading = objects(
      "<CANopenObject index=\"2000\" objectType=\"7\" name=\"a&#x41;&amp;&#228;&unknown;&#xD800;\r\nb\"><label "
      "lang='en'>"
      "<![CDATA[1 < 2]]></label><description>x\r\ny &lt;</description></CANopenObject>");
  const Entry& entry = reading.at(0x2000);
  CHECK(entry.name.text == "aA&\xC3\xA4&unknown;&#xD800; b");
  CHECK(entry.texts->labels.at(0).text.text == "1 < 2");
  CHECK(entry.texts->descriptions.at(0).text.text == "x\ny <");
}

TEST_CASE("XDD quirk: characters that are not UTF-8 are read with and without a declaration") {
  const std::string name = object("index=\"2000\" name=\"\xE4\" objectType=\"7\"");
  const XmlReading undeclared(xdd_with(name));
  CHECK(undeclared.at(0x2000).name.text == "\xC3\xA4");
  CHECK(undeclared.has("xdd-encoding"));
  CHECK_FALSE(XmlReading("<?xml version=\"1.0\" encoding=\"windows-1252\"?>" + xdd_with(name)).has("xdd-encoding"));
  const std::string marked = "\xEF\xBB\xBF<?xml version=\"1.0\"?>" + xdd_with(object("index=\"2000\" name=\"n\""));
  const XmlReading with_mark(marked);
  CHECK(with_mark.raw(with_mark.at(0x2000).name.span) == "n");
}
