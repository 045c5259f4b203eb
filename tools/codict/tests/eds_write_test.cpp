// SPDX-License-Identifier: Apache-2.0
// Writing of devices as new EDS and DCF. [306]
#include "eds/write.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "diff/diff.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "files.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using test::has;

namespace {

Device device_of(const std::string& text, const std::string& name = "device.dcf") {
  Findings findings;
  const eds::Document document(Source(name, text), findings);
  return eds::read(document, findings).devices.front();
}

std::string written(const Device& device, bool as_dcf = false) {
  eds::WriteOptions options;
  options.as_dcf = as_dcf;
  options.line_end = "\n";
  return eds::write(device, options);
}

// Returns the differences of a device after writing and reading it.
std::string differences(const Device& device) {
  std::string text;
  for (const diff::Difference& difference : diff::compare(device, device_of(written(device, true)))) {
    text += diff::to_string(difference.place) + " " + difference.what + ": " + difference.before + " -> " +
            difference.after + "\n";
  }
  return text;
}

void check_round_trip(const std::string& path) {
  CAPTURE(path);
  const Device device = device_of(test::bytes_of(path), path);
  CHECK(differences(device) == "");
  const std::string once = written(device, true);
  CHECK(written(device_of(once), true) == once);
}

}  // namespace

TEST_CASE("EDS writer: each fixture that is written and read again is the same device") {
  const std::vector<std::string> paths = test::files_in(test::fixture(""), test::eds_endings());
  CHECK(paths.size() > 50);
  for (const std::string& path : paths) {
    check_round_trip(path);
  }
}

TEST_CASE("EDS writer: each description of the corpus that is written and read again is the same device" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  for (const std::string& path : test::files_in(test::corpus(), test::eds_endings())) {
    check_round_trip(path);
  }
}

TEST_CASE("EDS writer: objects are written in their lists and with their sub-objects, by index [306: 4.6]") {
  CHECK(written(device_of("[2000]\nParameterName=Speed\nObjectType=7\nDataType=6\nAccessType=rw\nDefaultValue=5\n"
                          "[1018sub1]\nParameterName=Vendor\nDataType=7\nAccessType=ro\nDefaultValue=0x12\n"
                          "[1018]\nParameterName=Identity\nObjectType=9\nSubNumber=7\n"
                          "[1018sub0]\nParameterName=Highest\nDataType=5\nAccessType=const\nDefaultValue=1\n"
                          "[1008]\nParameterName=Name\nObjectType=7\nDataType=9\nAccessType=const\n")) ==
        "[FileInfo]\n\n[DeviceInfo]\n\n"
        "[MandatoryObjects]\nSupportedObjects=1\n1=0x1018\n\n"
        "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=2\n\n"
        "[1018sub0]\nParameterName=Highest\nObjectType=0x7\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n"
        "[1018sub1]\nParameterName=Vendor\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0x12\n\n"
        "[OptionalObjects]\nSupportedObjects=1\n1=0x1008\n\n"
        "[1008]\nParameterName=Name\nObjectType=0x7\nDataType=0x0009\nAccessType=const\n\n"
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n"
        "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=5\n");
}

TEST_CASE("EDS writer: configured values are written to a DCF only") {
  const Device device = device_of(
      "[DeviceComissioning]\nNodeID=5\n[2000]\nParameterName=Speed\nObjectType=7\nDataType=6\nAccessType=rw\n"
      "DefaultValue=5\nParameterValue=7\nDenotation=left\n");
  const std::string dcf = written(device, true);
  CHECK(has(dcf, "[DeviceComissioning]\nNodeID=5\n"));
  CHECK(has(dcf, "ParameterValue=7\nDenotation=left\n"));
  const std::string eds = written(device, false);
  CHECK_FALSE(has(eds, "DeviceComissioning"));
  CHECK_FALSE(has(eds, "ParameterValue"));
  CHECK_FALSE(has(eds, "Denotation"));
  CHECK(has(eds, "DefaultValue=5\n"));
}

TEST_CASE("EDS writer: values are written with the words of CiA 306") {
  const auto value = [](const std::string& type, const std::string& text) {
    const std::string eds = written(device_of("[2000]\nParameterName=x\nObjectType=7\nDataType=" + type +
                                              "\nAccessType=rw\nDefaultValue=" + text + "\n"));
    const std::size_t at = eds.find("DefaultValue=") + 13;
    return eds.substr(at, eds.find('\n', at) - at);
  };
  CHECK(value("6", "0x10") == "0x10");
  CHECK(value("6", "16") == "16");
  CHECK(value("7", "$NODEID+0x180") == "$NODEID+0x180");
  CHECK(value("7", "0x180+$NODEID") == "$NODEID+0x180");
  CHECK(value("7", "$NodeId + 384") == "$NODEID+0x180");
  CHECK(value("1", "true") == "1");
  CHECK(value("3", "-5") == "-5");
  CHECK(value("6", "0x3ED ; why") == "1005");
  CHECK(value("0x0A", "01 02 ff") == "0102FF");
  CHECK(value("8", "1.5") == "1.5");
  CHECK(value("9", "text, with = and ;") == "text, with = and ;");
}

TEST_CASE("EDS writer: access and direction of PDOs are written as one word") {
  const auto access = [](Access given, PdoMapping mapping) {
    Device device = device_of("[2000]\nParameterName=x\nObjectType=7\nDataType=6\nAccessType=rw\n");
    device.objects.front().access.value = given;
    device.objects.front().pdo_mapping.value = mapping;
    const std::string eds = written(device);
    return eds.substr(eds.find("AccessType="));
  };
  CHECK(access(Access::rw, PdoMapping::tpdo) == "AccessType=rwr\nPDOMapping=1\n");
  CHECK(access(Access::rw, PdoMapping::rpdo) == "AccessType=rww\nPDOMapping=1\n");
  CHECK(access(Access::rw, PdoMapping::optional) == "AccessType=rw\nPDOMapping=1\n");
  CHECK(access(Access::ro, PdoMapping::tpdo) == "AccessType=ro\nPDOMapping=1\n");
  CHECK(access(Access::ro, PdoMapping::no) == "AccessType=ro\n");
}

TEST_CASE("EDS writer: compact storage stays compact, with its own names and values [306: 4.6.4]") {
  const std::string dcf = written(
      device_of("[2000]\nParameterName=Gain\nObjectType=8\nDataType=6\nAccessType=rw\nCompactSubObj=3\nDefaultValue=1\n"
                "[2000Name]\nNrOfEntries=1\n2=Second\n[2000Value]\nNrOfEntries=1\n3=7\n"),
      true);
  CHECK(has(dcf, "CompactSubObj=3\n"));
  CHECK(has(dcf, "[2000Name]\nNrOfEntries=1\n2=Second\n"));
  CHECK(has(dcf, "[2000Value]\nNrOfEntries=1\n3=7\n"));
  CHECK_FALSE(has(dcf, "2000sub"));
}

TEST_CASE("EDS writer: keys and sections unknown to CiA 306 stay at their places") {
  const std::string eds =
      written(device_of("[DeviceInfo]\nProductVersion=1\nColour=red\n[Tools]\nItems=0\n[Mine]\na=b\n"
                        "[2000]\nParameterName=x\nObjectType=7\nDataType=6\nAccessType=rw\nMyKey=my value\n"));
  CHECK(has(eds, "[DeviceInfo]\nProductVersion=1\nColour=red\n"));
  CHECK(has(eds, "[Tools]\nItems=0\n"));
  CHECK(has(eds, "[Mine]\na=b\n"));
  CHECK(has(eds, "MyKey=my value\n"));
  CHECK(has(written(device_of("[DeviceCommissioning]\nNodeID=5\nColour=red\n"), true),
            "[DeviceComissioning]\nNodeID=5\nColour=red\n"));
}

TEST_CASE("EDS writer: a text cannot begin another line") {
  Device device = device_of("[2000]\nParameterName=x\nObjectType=7\nDataType=9\nAccessType=rw\nDefaultValue=a\n");
  device.objects.front().name.text = "a\n[3000]\r\nb";
  CHECK(device_of(written(device)).objects.size() == 1);
}

TEST_CASE("EDS writer: dates and times of XML Schema are written in the form of CiA 306") {
  const std::pair<const char*, const char*> times[] = {{"00:05:59", "12:05AM"}, {"09:30:00Z", "09:30AM"},
                                                       {"12:00:00", "12:00PM"}, {"23:59:00", "11:59PM"},
                                                       {"09:30PM", "09:30PM"},  {"noon", "noon"}};
  for (const auto& [schema, eds] : times) {
    Device device;
    device.format = Format::xdd11;
    device.file.creation_date.text = "2024-02-29+01:00";
    device.file.modification_date.text = "02-29-2024";
    device.file.modification_time.text = schema;
    const std::string text = written(device);
    CHECK(has(text, "CreationDate=02-29-2024\n"));
    CHECK(has(text, "ModificationDate=02-29-2024\n"));
    CHECK(has(text, std::string("ModificationTime=") + eds + "\n"));
  }
}

TEST_CASE("EDS writer: invalid numbers and flags are written unchanged, not as 0") {
  const std::string dcf =
      "[FileInfo]\nFileVersion=1.2.3\nFileRevision=300\n[DeviceInfo]\nNrOfRXPDO=many\nLSS_Supported=maybe\n"
      "BaudRate_500=often\n[DummyUsage]\nDummy0005=perhaps\n[DynamicChannels]\nNrOfSeg=1\nType1=five\nDir1=up\n"
      "Range1=all\nPPOffset1=far\n[DeviceComissioning]\nNodeID=first\nCANopenManager=sometimes\n"
      "[2000]\nParameterName=x\nDataType=70000\nAccessType=rw\nPDOMapping=maybe\nObjFlags=some\n"
      "[2000ObjectLinks]\nObjectLinks=1\n1=next\n[ConnectedModules]\nNrOfEntries=1\n1=first\n";
  const std::string again = written(device_of(dcf), true);
  std::istringstream lines(dcf);
  for (std::string line; std::getline(lines, line);) {
    CAPTURE(line);
    CHECK(has(again, line + "\n"));
  }
  CHECK(has(written(device_of("[DeviceInfo]\nNrOfRXPDO=8u\nLSS_Supported=true\nLSS_Master=FALSE\n")),
            "LSS_Supported=1\nLSS_Master=0\n"));
  CHECK(has(written(device_of("[DeviceInfo]\nNrOfRXPDO=8u\nNrOfTXPDO=0 ; none\n")), "NrOfRXPDO=8\nNrOfTXPDO=0\n"));
}

TEST_CASE("EDS writer: no text produces a file that cannot be read") {
  Device device = device_of("[2000]\nParameterName=x\nObjectType=7\nDataType=9\nAccessType=rw\nDefaultValue=a\n");
  device.objects.front().name.text = std::string("a\0b", 3);
  device.others.push_back(
      {std::string("Mine\nand\0yours", 14), {}, {{std::string("k\0\n", 3), {"v", {}, true}, {}, {}}}, {}});
  const std::string eds = written(device);
  CHECK(eds.find('\0') == std::string::npos);
  CHECK(has(eds,
            "ParameterName=a\xEF\xBF\xBD"
            "b\n"));
  CHECK(has(eds, "[Mine and\xEF\xBF\xBDyours]\nk\xEF\xBF\xBD =v\n"));
  CHECK(device_of(eds).objects.size() == 1);
}
