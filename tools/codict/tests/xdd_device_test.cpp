// SPDX-License-Identifier: Apache-2.0
// Reading of device data of CiA 311 into the model. [311]
#include <doctest/doctest.h>

#include "reading.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;
using test::fixture_xml;
using test::meaning;
using test::XmlReading;

TEST_CASE("XDD: a valid description has no finding except for a parameter without object") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  CHECK(reading.found() == "107 xdd-parameter-unused\n");
  CHECK(reading.device.format == Format::xdc10);
  CHECK(reading.device.parameters.size() == 1);
}

TEST_CASE("XDD: file, profile and identity are read") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Device& device = reading.device;
  CHECK(device.file.file_name.text == "device10.xdd");
  CHECK(device.file.created_by.text == "Ada");
  CHECK(device.file.creation_date.text == "2024-02-29");
  CHECK(device.file.version.value == 7);
  CHECK(device.file.supported_languages.text == "en de");
  CHECK(device.file.device_class.text == "compact");
  CHECK(device.device_profile.source.text == "Own & Sons");
  CHECK(device.communication_profile.class_id.text == "CommunicationNetwork");
  CHECK(device.identity.vendor_number.value == 0x123);
  CHECK(device.identity.vendor_text.text == "Makers of valves");
  CHECK(device.identity.family_texts.labels.size() == 2);
  CHECK(device.identity.product_number.value == 0x42);
  CHECK(device.identity.order_codes.size() == 2);
  CHECK(device.identity.versions.at(1).type.text == "HW");
  CHECK(device.identity.specification_revision.text == "2");
}

TEST_CASE("XDD: EDS keys in the description of a product are read like those of an EDS") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  CHECK(reading.device.file.description.text == "A valve");
  CHECK(reading.device.file.eds_version.text == "4.0");
  CHECK(reading.device.file.revision.value == 3);
  CHECK(reading.device.identity.revision_number.value == 0x10002);
}

TEST_CASE("XDD: bit rates, features, commissioning, dummies and dynamic channels are read") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Device& device = reading.device;
  CHECK(device.features.default_bit_rate.value == 250);
  REQUIRE(device.features.bit_rates.size() == 3);
  CHECK(device.features.bit_rates[1].kbit == 1000);
  CHECK(device.features.bit_rates[2].kbit == 0);
  CHECK(device.features.bit_rates[2].supported.value);
  CHECK(device.features.self_starting.value);
  CHECK(device.features.lss_slave.value);
  CHECK(device.features.flying_master.value);
  CHECK(device.features.granularity.value == 8);
  CHECK(device.features.tx_pdos.value == 1);
  CHECK(device.commissioning.node_id.value == 5);
  CHECK(device.commissioning.bit_rate.value == 125);
  CHECK(device.commissioning.network_name.text == "N");
  REQUIRE(device.dummies.size() == 2);
  CHECK(device.dummies[0].type == 5);
  CHECK(device.dummies[0].supported.value);
  CHECK_FALSE(device.dummies[1].supported.value);
  REQUIRE(device.dynamic_channels.size() == 1);
  CHECK(device.dynamic_channels[0].access.value == Access::ro);
  CHECK(device.dynamic_channels[0].last_index.value == 0xA03F);
  CHECK(device.dynamic_channels[0].offset.value == 0x40);
}

TEST_CASE("XDD: an object without a parameter is read from its attributes") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  CHECK(reading.at(0x1001).data_type.value == 5);
  CHECK(reading.at(0x1001).access.value == Access::ro);
  CHECK(reading.at(0x1001).pdo_mapping.value == PdoMapping::tpdo);
  CHECK(reading.at(0x1005).flags->value == 3);
  CHECK(meaning(reading.at(0x1800, 1).default_value) == "$NODEID+384");
  CHECK(meaning(reading.at(0x1800, 1).low_limit) == "129");
  CHECK(reading.device.find(0x1800)->sub_number.value == 2);
  CHECK(reading.at(0x2003).data_type.value == 0x0C);
  CHECK(reading.at(0x2003).denotation->text == "clock");
}

TEST_CASE("XDD: an object has the values of its parameter") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Entry& mode = reading.at(0x2000);
  CHECK(mode.access.value == Access::rww);
  CHECK(mode.data_type.value == 5);
  CHECK(mode.type->reference.text == "T_MODE");
  CHECK(mode.persistent->value);
  CHECK(meaning(mode.actual_value) == "1");
  CHECK(meaning(mode.substitute_value) == "1");
  CHECK(mode.denotation->text == "mode");
  CHECK(mode.denotations->labels.at(0).language == "en");
  CHECK(text_in(mode.texts->labels, "de") == "Betriebsart");
  CHECK(mode.unit->texts.labels.at(0).text.text == "step");
  CHECK(mode.allowed->values.at(1).texts.labels.at(0).text.text == "on");
  CHECK(meaning(mode.allowed->ranges.at(0).step) == "1");
  CHECK(mode.conditional_support->at(0).text == "P_1000");
  CHECK(reading.at(0x1000).texts->descriptions.at(0).text.text == "What it is,\nin two lines.");
}

TEST_CASE("XDD: the only range of a parameter gives the limits of the object") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Entry& opening = reading.at(0x2002, 2);
  CHECK(meaning(opening.low_limit) == "0");
  CHECK(meaning(opening.high_limit) == "100");
  CHECK(opening.data_type.value == 6);  // derived type
  CHECK(opening.access.value == Access::rwr);
}

TEST_CASE("XDD: a template gives missing values of its parameter; without access CiA 311 means read") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  CHECK(reading.at(0x2002, 1).data_type.value == 6);
  CHECK(reading.at(0x2002, 1).access.value == Access::constant);
  CHECK(fixture_xml("unqualified11.xdd").at(0x1001).access.value == Access::ro);
}

TEST_CASE("XDD: types, templates and groups are read") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Device& device = reading.device;
  REQUIRE(device.types.size() == 4);
  CHECK(device.types[0].kind == TypeDefinition::Kind::array);
  CHECK(device.types[0].bounds.at(0).upper.value == 2);
  CHECK(device.types[1].members.at(0).type.code == 7);
  CHECK(device.types[2].values.at(1).texts.labels.at(1).text.text == "an");
  CHECK(device.types[3].type.code == 6);
  CHECK(device.templates.at(0).parameter_id->text == "TPL_RO");
  CHECK(device.allowed_templates.at(0).allowed.values.size() == 2);
  CHECK(device.groups.at(0).groups.at(0).parameters.at(0).text == "P_OPENING");
}

TEST_CASE("XDD: properties of CANopenNode are read, new generation") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  const Entry& mode = reading.at(0x2000);
  CHECK(mode.node->disabled->is_given);
  CHECK_FALSE(mode.node->disabled->value);
  CHECK(mode.node->count_label->text == "MODE");
  CHECK(mode.node->storage_group.value == "PERSIST_COMM");
  CHECK(mode.node->srdo->value == SrdoAccess::trx);
  CHECK(reading.at(0x2001).node->string_length_min->value == 16);
  REQUIRE(mode.properties->size() == 1);
  CHECK(mode.properties->at(0).name == "Own");
}

TEST_CASE("XDD: properties of CANopenNode are read, old generation") {
  const XmlReading reading = test::fixture_xml("unqualified11.xdd");
  const Entry& own = reading.at(0x2002);
  CHECK(own.access.value == Access::none);
  CHECK(own.node->storage_group.value == "RAM");
  CHECK(own.node->extension_io->value);
  CHECK(own.node->flags_pdo->value);
  CHECK(own.node->byte_length->value == 12);
  CHECK(own.default_value.is_given);
  CHECK(meaning(own.default_value) == "none");
}

TEST_CASE("XDD: a BITSTRING with a default is an OCTET_STRING, without one a DOMAIN") {
  const XmlReading reading = test::fixture_xml("unqualified11.xdd");
  CHECK(reading.at(0x2000).data_type.value == type_code::octet_string);
  CHECK(meaning(reading.at(0x2000).default_value) == "octets 01 02 FF");
  CHECK(reading.at(0x2001).data_type.value == type_code::domain);
}

TEST_CASE("XDD: known and unused elements are kept without a finding") {
  const XmlReading reading = test::fixture_xml("device10.xdd");
  bool has_led = false;
  for (const OpaquePart& kept : reading.device.others) {
    has_led = has_led || (kept.name == "DeviceManager" &&
                          kept.children.at(0).children.at(0).children.at(0).children.at(0).text.text == "bicolor");
  }
  CHECK(has_led);
}
