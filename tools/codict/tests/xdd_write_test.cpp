// SPDX-License-Identifier: Apache-2.0
// Writing and reading a device gives an equal device.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "reading.hpp"
#include "xdd/write.hpp"
#include "xdd_dump.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::XmlReading;

namespace {

constexpr xdd::Edition editions[] = {xdd::Edition::v10, xdd::Edition::v11};

bool says(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Returns true if the text contains all parts in this order.
bool in_order(const std::string& text, std::initializer_list<const char*> parts) {
  std::size_t at = 0;
  for (const char* part : parts) {
    at = text.find(part, at);
    if (at == std::string::npos) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("XDD write: a description of CiA 311 that is written and read again is the same, in both editions") {
  for (const std::string name : {"device10.xdd", "unqualified11.xdd"}) {
    CAPTURE(name);
    const XmlReading reading(test::bytes_of_fixture(name));
    for (const xdd::Edition edition : editions) {
      const std::string written = xdd::write(reading.device, edition);
      const XmlReading again(written);
      CHECK(dump(again.device) == dump(reading.device));
      CHECK(xdd::write(again.device, edition) == written);
      CHECK_FALSE(again.has("xdd-order"));
      CHECK_FALSE(again.has("xdd-name-case"));
    }
  }
}

TEST_CASE("XDD write: the objects of other dialects are the same after writing and reading") {
  for (const std::string name : {"indexed.xdd", "elements.xdd", "project.xml", "foreign_namespace.xml"}) {
    CAPTURE(name);
    const XmlReading reading(test::bytes_of_fixture(name));
    for (const xdd::Edition edition : editions) {
      const std::string written = xdd::write(reading.device, edition);
      const XmlReading again(written);
      for_each_variable(reading.device, [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
        const Entry& other = again.at(index, sub_index);
        CHECK(other.name.text == entry.name.text);
        CHECK(other.data_type.value == entry.data_type.value);
        CHECK(other.access.value == entry.access.value);
        CHECK(meaning(other.default_value) == meaning(entry.default_value));
        CHECK(meaning(other.high_limit) == meaning(entry.high_limit));
      });
      CHECK(xdd::write(again.device, edition) == written);
    }
  }
}

TEST_CASE("XDD write: parameters, labels and dates of an EDS are written in the form of CiA 311") {
  for (const std::string name : {"access.eds", "limits.eds", "real.eds", "octets.eds", "node_id.eds", "sub_zero.eds"}) {
    CAPTURE(name);
    const test::Reading eds(name);
    const XmlReading again(xdd::write(eds.device, xdd::Edition::v11));
    for_each_variable(eds.device, [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
      const Entry& other = again.at(index, sub_index);
      CAPTURE(index);
      CHECK(other.name.text == entry.name.text);
      CHECK(text_in(other.texts->labels, "en") == entry.name.text);
      CHECK(other.data_type.value == entry.data_type.value);
      if (entry.access.value != Access::unknown) {
        CHECK(other.access.value == entry.access.value);
      }
      CHECK(other.pdo_mapping.value == entry.pdo_mapping.value);
      CHECK(other.low_limit->text == entry.low_limit->text);
      CHECK(other.high_limit->text == entry.high_limit->text);
      if (entry.default_value.is_given) {
        CHECK(meaning(other.default_value) == meaning(entry.default_value));
      }
    });
  }
}

TEST_CASE("XDD write: 1.0 has all elements in the namespace, 1.1 only global ones") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const std::string v10 = xdd::write(reading.device, xdd::Edition::v10);
  CHECK(says(v10, "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\""));
  CHECK(says(v10, "xsi:type=\"ProfileBody_Device_CANopen\""));
  CHECK_FALSE(says(v10, "co:"));
  const std::string v11 = xdd::write(reading.device, xdd::Edition::v11);
  CHECK(says(v11, "<co:ISO15745ProfileContainer xmlns:co=\"http://www.canopen.org/xml/1.1\""));
  CHECK(says(v11, "xsi:type=\"co:ProfileBody_Device_CANopen\""));
  for (const char* global : {"<co:DeviceIdentity>", "<co:parameter ", "<co:defaultValue ", "<co:CANopenObjectList ",
                             "<co:property ", "<co:dataTypeIDRef ", "<co:range>"}) {
    CHECK(says(v11, global));
  }
  for (const char* local : {"<ProfileHeader>", "<ProfileBody ", "<label ", "<UDINT/>", "<CANopenObject ", "<minValue ",
                            "<ApplicationLayers>", "<dummy ", "<supportedBaudRate "}) {
    CHECK(says(v11, local));
  }
}

TEST_CASE("XDD write: order of the schema, exact digits, both notations of the type and nodeID are written") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const std::string written = xdd::write(reading.device, xdd::Edition::v11);
  CHECK(in_order(written, {"<label lang=\"en\">Mode", "<co:dataTypeIDRef", "<co:conditionalSupport", "<co:denotation>",
                           "<co:actualValue", "<co:defaultValue", "<co:substituteValue", "<co:allowedValues>",
                           "<co:value value=\"0\">", "<co:range>", "<co:unit", "<co:property"}));
  CHECK(in_order(written, {"<co:dataTypeList>", "<co:templateList>", "<co:parameterList>", "<co:parameterGroupList>"}));
  CHECK(in_order(written,
                 {"<co:DeviceIdentity>", "<co:DeviceManager>", "<co:DeviceFunction/>", "<co:ApplicationProcess>"}));
  CHECK(
      says(written, "<CANopenObject index=\"1000\" name=\"Device type\" objectType=\"7\" dataType=\"07\" uniqueIDRef"));
  CHECK(says(written, "<CANopenObject index=\"2003\" name=\"Time\" objectType=\"7\" dataType=\"0C\""));
  CHECK(says(written, "objFlags=\"0003\""));
  CHECK(says(written, "<deviceCommissioning nodeID=\"5\""));
}

TEST_CASE("XDD write: a single limit and an empty default are kept") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  CHECK(says(xdd::write(reading.device, xdd::Edition::v10), "lowLimit=\"0x81\""));
  const XmlReading empty(test::bytes_of_fixture("unqualified11.xdd"));
  CHECK(says(xdd::write(empty.device, xdd::Edition::v11), "<co:defaultValue value=\"\"/>"));
}

TEST_CASE("XDD write: markup characters and line ends are kept; those that XML forbids are replaced [XML 1.0: 2.2]") {
  XmlReading reading = test::fixture_xml("device10.xdd");
  const std::string text = "a<b>&\"c'\td\ne\rf";
  Object& object = *reading.device.find(0x1000);
  object.name.text = text;
  object.texts.edit().labels.at(0).text.text = text;
  object.default_value.text = std::string("a\0b\x01", 4);
  const XmlReading again(xdd::write(reading.device, xdd::Edition::v11));
  CHECK(again.at(0x1000).name.text == text);
  CHECK(again.at(0x1000).texts->labels.at(0).text.text == text);
  CHECK(again.at(0x1000).default_value.text ==
        "a\xEF\xBF\xBD"
        "b\xEF\xBF\xBD");
}

TEST_CASE("XDD write: the implied sub-index 0 of CiA 306 is written with its type [306: 4.6.3, 4.6.4]") {
  const test::Reading compact("compact.dcf");
  const std::string written = xdd::write(compact.device, xdd::Edition::v11);
  CHECK(says(written, "<CANopenSubObject subIndex=\"00\" name=\"NrOfObjects\" objectType=\"7\" dataType=\"05\""));
  const XmlReading again(written);
  CHECK(meaning(again.at(0x2000, 0).default_value) == meaning(compact.value(0x2000, 0)));
  CHECK(again.at(0x2000, 0).access.value == Access::ro);
  const test::Reading zero("sub_zero.eds");
  const XmlReading zero_again(xdd::write(zero.device, xdd::Edition::v10));
  for_each_variable(zero.device, [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
    CHECK(meaning(zero_again.at(index, sub_index).default_value) == meaning(entry.default_value));
  });
}

TEST_CASE("XDD write: names that XML does not allow are changed to valid ones") {
  XmlReading reading = test::fixture_xml("device10.xdd");
  OpaquePart element{"a <b/>", {"x", {}, true}, {}, {}};
  element.children.push_back({"@1=\"", {"y", {}, true}, {}, {}});
  reading.device.others.push_back(element);
  const std::string written = xdd::write(reading.device, xdd::Edition::v10);
  CHECK(says(written, "<a__b__ _1__=\"y\">x</a__b__>"));
  CHECK_FALSE(XmlReading(written).has("xdd-syntax"));
}

TEST_CASE("XDD write: invalid numbers and flags are written unchanged") {
  test::Reading reading("drive.eds");
  const auto set = [](Text& text, const char* to) {
    text.text = to;
    text.is_given = true;
  };
  Features& features = reading.device.features;
  features.rx_pdos.value = 0;
  set(features.rx_pdos, "many");
  features.lss_slave.value = false;
  set(features.lss_slave, "maybe");
  features.granularity.value = 0;
  set(features.granularity, "fine");
  reading.device.dummies.resize(1);
  reading.device.dummies[0].supported.value = false;
  set(reading.device.dummies[0].supported, "perhaps");
  set(reading.device.objects[0].flags.edit(), "some");
  const std::string written = xdd::write(reading.device, xdd::Edition::v11);
  CHECK(says(written, "nrOfRxPDO=\"many\""));
  CHECK(says(written, "layerSettingServiceSlave=\"maybe\""));
  CHECK(says(written, "granularity=\"fine\""));
  CHECK(says(written, "=perhaps\""));
  CHECK(says(written, "objFlags=\"some\""));
}
