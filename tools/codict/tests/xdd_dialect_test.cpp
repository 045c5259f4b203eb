// SPDX-License-Identifier: Apache-2.0
// XML descriptions in forms that deviate from the standard and are in use.
#include <doctest/doctest.h>

#include "reading.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::XmlReading;

TEST_CASE("XDD 1.1: elements without namespace, prefixes and names in other capitals are read") {
  const XmlReading reading = test::fixture_xml("unqualified11.xdd");
  const Device& device = reading.device;
  CHECK(device.format == Format::xdc11);
  CHECK(device.identity.vendor_name.text == "V");
  CHECK(device.features.node_guarding_slave.value);
  CHECK(device.features.guarded_nodes.value == 3);
  CHECK(device.commissioning.node_id.value == 9);
  CHECK(device.commissioning.bit_rate.value == 1000);
  CHECK(reading.found() == "51 xdd-name-case\n51 xdd-bit-rate\n51 xdd-boolean\n");
}

TEST_CASE("maxon: parameters with an index become objects") {
  const XmlReading reading = test::fixture_xml("indexed.xdd");
  CHECK(reading.device.dialect == "maxon");
  CHECK(reading.device.objects.size() == 2);
  CHECK(reading.at(0x1000).data_type.value == 7);
  CHECK(reading.at(0x1000).object_code.value == ObjectCode::variable);
  CHECK(reading.at(0x1000).pdo_mapping.value == PdoMapping::tpdo);
  CHECK(meaning(reading.at(0x1000).default_value) == "131474");
  const Object& motor = *reading.device.find(0x3001);
  CHECK(motor.object_code.value == ObjectCode::record);
  CHECK(motor.name.text == "Motor");
  CHECK(motor.subs.size() == 3);
  CHECK(reading.at(0x3001, 1).data_type.value == 5);
  CHECK(meaning(reading.at(0x3001, 1).default_value) == "3");
  CHECK(reading.at(0x3001, 1).allowed->values.at(1).texts.labels.at(0).text.text == "On");
  CHECK(reading.at(0x3001, 2).access.value == Access::rw);
  CHECK(meaning(reading.at(0x3001, 2).high_limit) == "5000");
  CHECK(reading.at(0x3001, 2).unit->multiplier.text == "1");
  CHECK(reading.found() == "3 xdd-dialect\n26 xdd-duplicate-object\n");
  CHECK(reading.device.others.back().children.front().text.text == "P_Again");
}

TEST_CASE("DeviceProfile: elements in place of attributes of CiA 311 are read") {
  const XmlReading reading = test::fixture_xml("elements.xdd");
  CHECK(reading.device.identity.product_name.text == "Box");
  CHECK(reading.at(0x2000).name.text == "First");
  CHECK(reading.at(0x2000).data_type.value == 6);
  CHECK(meaning(reading.at(0x2000).default_value) == "3");
  CHECK(reading.at(0x2001, 1).data_type.value == 4);
  CHECK(reading.has("xdd-dialect"));
}

TEST_CASE("_project.xml of CANopenNode: memory types and empty elements of an ARRAY are read") {
  const XmlReading reading(test::bytes_of_fixture("project.xml"), "_project.xml");
  CHECK(reading.device.format == Format::project_xml);
  CHECK(reading.device.file.created_by.text == "JP");
  CHECK(reading.device.identity.vendor_name.text == "V");
  CHECK(reading.device.features.bit_rates.at(0).kbit == 10);
  CHECK(reading.device.dummies.at(0).type == 2);
  CHECK(reading.at(0x1000).node->storage_group.value == "ROM");
  CHECK(reading.at(0x1000).texts->descriptions.at(0).text.text == "What it is.");
  CHECK(reading.at(0x1003, 2).data_type.value == 7);
  CHECK(reading.at(0x1003, 2).access.value == Access::ro);
  CHECK(reading.at(0x6000).node->disabled->value);
  CHECK(reading.at(0x6000).node->flags_pdo->value);
  CHECK(reading.device.find(0x1003)->others.at(0).text.text == "CO_ODF_1003");
}

TEST_CASE("XDD: the storage group in an attribute of older CANopenEditors is read, also with a parameter") {
  const std::string objects =
      "<CANopenObject index=\"2000\" name=\"a\" objectType=\"7\" edseditor_extenstion_storagelocation=\"EEPROM\"/>"
      "<CANopenObject index=\"2001\" name=\"b\" objectType=\"7\" uniqueIDRef=\"P\" "
      "edseditor_extenstion_storagelocation=\"EEPROM\"/>";
  const XmlReading reading(test::xdd_with(objects, "<parameter uniqueID=\"P\"><USINT/></parameter>"));
  CHECK(reading.at(0x2000).node->storage_group.value == "EEPROM");
  CHECK(reading.at(0x2001).node->storage_group.value == "EEPROM");
}

TEST_CASE(".nxdd: several devices in one file are read") {
  const XmlReading reading(test::bytes_of_fixture("several.nxdd"), "several.nxdd");
  REQUIRE(reading.description.devices.size() == 2);
  CHECK(reading.description.devices[0].identity.product_name.text == "One");
  CHECK(reading.description.devices[0].objects.size() == 1);
  CHECK(reading.description.devices[1].identity.product_name.text == "Two");
  CHECK(reading.device.format == Format::nxdd);
}

TEST_CASE("XDD: another namespace or none is reported; profiles may have any order") {
  const XmlReading reading = test::fixture_xml("foreign_namespace.xml");
  CHECK(reading.has("xdd-namespace"));
  CHECK(reading.at(0x2000).texts->labels.at(0).text.text == "Value");
  CHECK(XmlReading("<ISO15745ProfileContainer/>").found() == "1 xdd-namespace\n");
}

TEST_CASE("XDD: the suffix selects a profile database or a configured device") {
  const std::string bytes = test::xdd_with("");
  CHECK(XmlReading(bytes, "a.xpd").device.format == Format::xpd);
  CHECK(XmlReading(bytes, "a.XDC").device.format == Format::xdc10);
  CHECK(XmlReading(bytes, "a.xdd").device.format == Format::xdd10);
}
