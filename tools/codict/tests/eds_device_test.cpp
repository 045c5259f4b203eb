// SPDX-License-Identifier: Apache-2.0
// Reading of an EDS or DCF: data of the whole device, compact storage, modules.
#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"
#include "eds/read.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using test::meaning;
using test::Reading;

namespace {

// Returns the messages of check_device() about a section [DeviceComissioning] with these keys.
std::string commissioning_faults(const std::string& keys) {
  Findings of_reader;
  const eds::Document document(Source("a.dcf", "[DeviceComissioning]\n" + keys), of_reader);
  Findings findings;
  check::check_device(eds::read(document, of_reader).devices.front(), findings);
  std::string text;
  for (const Finding& finding : findings.all()) {
    text += std::string(finding.rule->id) + ": " + finding.text + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("EDS: FileInfo is read; deviations in its form are reported [306: 4.4]") {
  const Reading eds("file_info.eds");
  const FileInfo& file = eds.device.file;
  CHECK(file.file_name.text == "another.eds");
  CHECK(file.version.value == 2);
  CHECK(file.revision.value == 7);
  CHECK(file.eds_version.text == "404");
  CHECK(file.description.text == "What it is");
  CHECK(file.creation_time.text == "9:30");
  CHECK(file.creation_date.text == "2020-12-31");
  CHECK(file.created_by.text == "Somebody");
  CHECK(file.modification_time.text == "09:30PM");
  CHECK(file.modification_date.text == "01-02-2021");
  CHECK(file.modified_by.text == "Somebody else");
  CHECK(eds.device.format == Format::eds);
  CHECK(eds.found() ==
        "2:10 eds-file-name\n5:12 eds-file-version\n7:14 eds-file-time\n8:14 eds-file-date\n13:1 eds-key-unknown\n"
        "17:14 od-identity\n32:11 od-pdo-count\n37:1 eds-key-unknown\n44:7 eds-list-count\n");
}

TEST_CASE("EDS: DeviceInfo is read with keys of earlier and later versions [306: 4.5]") {
  const Reading eds("file_info.eds");
  const Identity& identity = eds.device.identity;
  CHECK(identity.vendor_name.text == "Example");
  CHECK(identity.vendor_number.value == 0x1F);
  CHECK(identity.product_name.text == "Drive");
  CHECK(identity.product_number.value == 17);
  CHECK(identity.revision_number.value == 0x00010002);
  CHECK(identity.order_codes.at(0).text == "ABC-1");
  const Features& features = eds.device.features;
  CHECK(features.bit_rates.size() == 4);
  CHECK(features.bit_rates.at(0).kbit == 10);
  CHECK_FALSE(features.bit_rates.at(0).supported.value);
  CHECK(features.bit_rates.at(2).kbit == 100);
  CHECK(features.bit_rates.at(3).kbit == 1000);
  CHECK(features.bit_rates.at(3).supported.value);
  CHECK_FALSE(features.boot_up_master.value);
  CHECK(features.boot_up_slave.value);
  CHECK(features.granularity.value == 8);
  CHECK(features.group_messaging.value);
  CHECK(features.rx_pdos.value == 1);
  CHECK(features.tx_pdos.is_given);
  CHECK(features.lss_slave.value);
  CHECK(features.node_guarding_slave.value);
  CHECK(eds.device.others.at(1).name == "DeviceInfo");
  CHECK(eds.device.others.at(1).children.at(0).name == "ProductVersion");
  CHECK(eds.device.others.at(1).children.at(1).text.text == "red");
}

TEST_CASE("EDS: dummies and comments are read") {
  const Reading eds("file_info.eds");
  CHECK(eds.device.dummies.size() == 2);
  CHECK(eds.device.dummies.at(1).type == 5);
  CHECK(eds.device.dummies.at(1).supported.value);
  CHECK(eds.device.comments.at(1).text == "Two");
}

TEST_CASE("DCF: commissioning is read [306: 5.3]") {
  const Reading dcf("compact.dcf");
  const Commissioning& commissioning = dcf.device.commissioning;
  CHECK(dcf.device.format == Format::dcf);
  CHECK(dcf.device.file.last_eds.text == "compact.eds");
  CHECK(commissioning.is_given);
  CHECK(commissioning.node_id.value == 5);
  CHECK(commissioning.node_name.text == "Left");
  CHECK(commissioning.bit_rate.value == 250);
  CHECK(commissioning.network_number.value == 1);
  CHECK(commissioning.network_name.text == "Floor");
  CHECK(commissioning.is_manager.is_given);
  CHECK(commissioning.serial_number.value == 0x12345678);
}

TEST_CASE("DCF: a duplicate section in the spelling DeviceCommissioning is read once") {
  const Reading dcf("commissioning.dcf");
  CHECK(dcf.device.commissioning.node_id.value == 20);
  CHECK(dcf.device.commissioning.network_reference.value == 2);
  CHECK(dcf.device.commissioning.is_manager.text == "yes");
  CHECK(dcf.device.others.at(0).children.at(0).text.text == "3");
  CHECK(dcf.found() == "20:2 eds-commissioning-spelling\n22:16 od-value-number\n26:2 eds-duplicate-section\n");
}

TEST_CASE("DCF: node-IDs other than 1 to 127 and FFh, and bit rates that CiA 301 does not define, are reported") {
  for (const std::string keys : {"NodeID=1", "NodeID=127", "NodeID=0xFF", "NodeID=", "NodeID=five", "NodeID=300",
                                 "Baudrate=0", "Baudrate=100", "Baudrate=1000", "Baudrate=fast", "NodeName=0"}) {
    CAPTURE(keys);
    CHECK(commissioning_faults(keys) == "");
  }
  CHECK(commissioning_faults("NodeID=0") == "od-node-id: node-ID 0 is not in the range 1 to 127\n");
  CHECK(commissioning_faults("NodeID=0x80\nBaudrate=333") ==
        "od-node-id: node-ID 128 is not in the range 1 to 127\nod-bit-rate: CiA 301 does not define 333 kbit/s\n");
}

TEST_CASE("DCF: ParameterValue, Denotation and the files of a DOMAIN are read [306: 5.2]") {
  const Reading dcf("compact.dcf");
  CHECK(meaning(dcf.at(0x1000).actual_value) == "401");
  CHECK(dcf.at(0x1000).denotation->text == "Kind");
  CHECK(dcf.at(0x2001).upload_file->text == "up.bin");
  CHECK(dcf.at(0x2001).download_file->text == "down.bin");
  CHECK(dcf.at(0x2001).parameter_reference->text == "3");
  CHECK(dcf.at(0x2001).data_type.value == type_code::domain);
  CHECK(dcf.at(0x2001).access.value == Access::rw);
}

TEST_CASE("DCF: compact storage expands to sub-objects with the attributes of the object [306: 4.6.4]") {
  const Reading dcf("compact.dcf");
  const Object& object = *dcf.device.find(0x2000);
  CHECK(object.subs.size() == 13);
  CHECK(dcf.at(0x2000, 0).name.text == "NrOfObjects");
  CHECK(dcf.at(0x2000, 0).access.value == Access::ro);
  CHECK(meaning(dcf.value(0x2000, 0)) == "12");
  CHECK(dcf.at(0x2000, 11).name.text == "Gain11");  // the number in the key is decimal
  CHECK(dcf.at(0x2000, 11).data_type.value == type_code::unsigned16);
  CHECK(dcf.at(0x2000, 11).access.value == Access::rw);
  CHECK(dcf.at(0x2000, 11).pdo_mapping.value == PdoMapping::optional);
  CHECK(meaning(dcf.value(0x2000, 11)) == "$NODEID+100");
  CHECK(object.find(11)->is_implied);
}

TEST_CASE("DCF: names, values, denotations and links of compact storage are read") {
  const Reading dcf("compact.dcf");
  CHECK(dcf.at(0x2000, 2).name.text == "Second gain");
  CHECK(meaning(dcf.at(0x2000, 1).actual_value) == "16");
  CHECK(meaning(dcf.at(0x2000, 12).actual_value) == "malformed");
  CHECK(meaning(dcf.at(0x2000, 3).actual_value) == "none");
  CHECK(dcf.at(0x2000, 12).denotation->text == "Last");
  CHECK(dcf.device.find(0x2000)->links.at(0).value == 0x2001);
  CHECK(dcf.device.find(0x2000)->others.at(0).children.at(0).text.text == "Not there");
  CHECK(dcf.device.find(0x2002)->subs.size() == 255);
  CHECK(dcf.found() == "48:1 eds-compact-entry\n53:4 od-value-range\n75:15 od-value-range\n");
}

TEST_CASE("EDS: modules and their objects are read [306: 4.7]") {
  const Reading eds("modules.eds");
  CHECK(eds.device.module_count.value == 3);
  CHECK(eds.device.modules.size() == 2);
  const Module& module = eds.device.modules.at(0);
  CHECK(module.number == 1);
  CHECK(module.product_name.text == "Eight inputs");
  CHECK(module.order_code.text == "DI8");
  CHECK(module.comments.at(0).text == "Small");
  CHECK(module.fixed_list.indexes.at(0).value == 0x2100);
  CHECK(module.fixed.at(0).index == 0x2100);
  CHECK(meaning(module.fixed.at(0).subs.at(1).default_value) == "20");
  CHECK(module.extension_list.indexes.size() == 2);
  CHECK(module.extensions.at(0).object.index == 0x6000);
  CHECK(module.extensions.at(0).object.access.value == Access::ro);
  CHECK(module.extensions.at(0).count.value == 1);
  CHECK(module.extensions.at(1).count.value == 0);
  CHECK(module.extensions.at(1).bits.value == 2);
  CHECK(module.extensions.at(1).object_extension.value == 1);
  CHECK(eds.device.connected_modules.at(0).value == 2);
  CHECK(eds.found() == "19:13 eds-list-count\n92:8 od-value-number\n");
}

TEST_CASE("EDS: dynamic channels are read") {
  const Reading eds("modules.eds");
  CHECK(eds.device.dynamic_channels.size() == 2);
  const DynamicChannel& channel = eds.device.dynamic_channels.at(0);
  CHECK(channel.data_type.value == 5);
  CHECK(channel.access.value == Access::ro);
  CHECK(channel.first_index.value == 0xA000);
  CHECK(channel.last_index.value == 0xA03F);
  CHECK(channel.offset.is_given);
  CHECK(eds.device.dynamic_channels.at(1).offset.value == 64);
  CHECK(eds.device.dynamic_channels.at(1).first_index.text == "0xA4C0");
}
