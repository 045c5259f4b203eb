// SPDX-License-Identifier: Apache-2.0
// Merging of overlays into a description.
#include "convert/merge.hpp"

#include <doctest/doctest.h>

#include <ctime>
#include <string>
#include <vector>

#include "convert/commission.hpp"
#include "convert/product.hpp"
#include "eds/read.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using convert::ReplacedValue;

namespace {

struct Merging {
  Merging(const std::string& base, const std::string& overlay) {
    Findings findings;
    is_possible = convert::merge(eds::Document(Source("base.eds", base), findings),
                                 eds::Document(Source("overlay.eds", overlay), findings), bytes, replaced);
  }

  std::string bytes;
  std::vector<ReplacedValue> replaced;
  bool is_possible = false;
};

std::string merged(const std::string& base, const std::string& overlay) { return Merging(base, overlay).bytes; }

}  // namespace

TEST_CASE("merge: values of an overlay replace those of the base, and all other bytes stay") {
  const Merging merging("; Mine\r\n[1a00Sub1]\r\nDefaultValue =  5 \r\nParameterName=x\r\n\r\n",
                        "[1A00sub1]\nDefaultValue=6\n");
  CHECK(merging.bytes == "; Mine\r\n[1a00Sub1]\r\nDefaultValue =  6 \r\nParameterName=x\r\n\r\n");
  REQUIRE(merging.replaced.size() == 1);
  CHECK(merging.replaced[0].section == "1a00Sub1");
  CHECK(merging.replaced[0].before == "5");
  CHECK(merging.replaced[0].after == "6");
  CHECK_FALSE(merging.replaced[0].is_definition());
  CHECK(Merging("[2000]\nDataType=5\n", "[2000]\nDataType=6\n").replaced.at(0).is_definition());
}

TEST_CASE("merge: equal values in another notation are not changed") {
  const std::string base = "[2000]\nDataType=0x0005\nDefaultValue=0x180+$NODEID\n";
  CHECK(merged(base, "[2000]\nDataType=5\nDefaultValue=$NODEID+0x180\n") == base);
  CHECK(Merging(base, "[2000]\nDataType=5\n").replaced.empty());
  CHECK(merged(base, "[2000]\nDefaultValue=0x180\n") == "[2000]\nDataType=0x0005\nDefaultValue=0x180\n");
}

TEST_CASE("merge: new keys follow the existing ones, also after an empty last one") {
  CHECK(merged("[2000]\nParameterName=\n[Mine]\n", "[2000]\nLowLimit=0\nHighLimit=9\nParameterName=x\n[Mine]\na=b\n") ==
        "[2000]\nParameterName=x\nLowLimit=0\nHighLimit=9\n[Mine]\na=b\n");
}

TEST_CASE("merge: new objects are inserted in order and added to their lists") {
  CHECK(
      merged("[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2005\n\n[2000]\nParameterName=a\n\n"
             "[2005]\nParameterName=b\n",
             "; not mine\n[2003sub1]\nParameterName=d\n\n[2003]\nParameterName=c\nSubNumber=1\n; why\n\n"
             "[2006]\nParameterName=e\n[ManufacturerObjects]\nSupportedObjects=2\n1=0x2003\n2=0x2006\n") ==
      "[ManufacturerObjects]\nSupportedObjects=4\n1=0x2000\n2=0x2005\n3=0x2003\n4=0x2006\n\n[2000]\nParameterName=a\n\n"
      "[2003]\nParameterName=c\nSubNumber=1\n; why\n\n[2003sub1]\nParameterName=d\n\n"
      "[2005]\nParameterName=b\n\n[2006]\nParameterName=e\n");
  CHECK(merged("[FileInfo]\nFileName=x\n", "[1008]\nParameterName=a\n") ==
        "[FileInfo]\nFileName=x\n\n[OptionalObjects]\nSupportedObjects=1\n1=0x1008\n\n[1008]\nParameterName=a\n");
}

TEST_CASE("merge: a new object follows keys that tools hide in comments and precedes other comments") {
  CHECK(merged("[2000]\nParameterName=a\n;StorageLocation=RAM\n; Five\n[2005]\nParameterName=b\n",
               "[2003]\nParameterName=c\n") ==
        "[2000]\nParameterName=a\n;StorageLocation=RAM\n\n[2003]\nParameterName=c\n; Five\n[2005]\nParameterName=b\n"
        "\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2003\n");
}

TEST_CASE("merge: new sub-objects are counted") {
  CHECK(merged("[2000]\nSubNumber=1\n\n[2000sub0]\nDataType=5\n\n[2001]\nDataType=5\n",
               "[2000]\nSubNumber=7\n[2000sub1]\nDataType=6\n[2000sub2]\nDataType=6\n") ==
        "[2000]\nSubNumber=3\n\n[2000sub0]\nDataType=5\n\n[2000sub1]\nDataType=6\n\n[2000sub2]\nDataType=6\n\n"
        "[2001]\nDataType=5\n");
}

TEST_CASE("merge: values of compact storage are counted") {
  CHECK(merged("[2000Value]\nNrOfEntries=1\n1=5\n", "[2000Value]\nNrOfEntries=2\n1=6\n3=7\n") ==
        "[2000Value]\nNrOfEntries=2\n1=6\n3=7\n");
}

TEST_CASE("merge: characters missing in the encoding of the base are refused") {
  const std::string base = test::bytes_of(test::fixture("cp850.eds"));
  CHECK(Merging(base, "[FileInfo]\nDescription=\xC3\xB6\n").is_possible);
  CHECK_FALSE(Merging(base, "[FileInfo]\nDescription=\xE2\x86\x92\n").is_possible);
  CHECK_FALSE(Merging(base, "[2009]\nParameterName=\xE2\x86\x92\n").is_possible);
}

TEST_CASE("merge: texts that resemble equal numbers are different") {
  CHECK(merged("[2000]\nDataType=9\nDefaultValue=007\nParameterName=10\n",
               "[2000]\nDefaultValue=7\nParameterName=0xA\n") ==
        "[2000]\nDataType=9\nDefaultValue=7\nParameterName=0xA\n");
  CHECK(merged("[2000]\nAccessType=RW\n", "[2000]\nAccessType=rw\n") == "[2000]\nAccessType=RW\n");
}

TEST_CASE("merge: new keys of a section are added to it, not to a new section after it") {
  CHECK(merged("[ManufacturerObjects]\nSupportedObjects=0\n", "[2000]\nParameterName=a\n") ==
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=a\n");
  CHECK(merged("[2000]\nCompactSubObj=5\n", "[2000sub3]\nParameterName=a\n") ==
        "[2000]\nCompactSubObj=5\nSubNumber=1\n\n[2000sub3]\nParameterName=a\n");
}

TEST_CASE("merge: a list with gaps is extended after its last number; FFh is not counted in SubNumber") {
  CHECK(merged("[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n5=0x2001\n[2000]\n[2001]\n",
               "[2002]\nParameterName=a\n") ==
        "[ManufacturerObjects]\nSupportedObjects=3\n1=0x2000\n5=0x2001\n6=0x2002\n[2000]\n[2001]\n\n[2002]\n"
        "ParameterName=a\n");
  CHECK(merged("[2000]\nSubNumber=1\n[2000sub0]\nDefaultValue=1\n", "[2000subFF]\nDefaultValue=7\n") ==
        "[2000]\nSubNumber=1\n[2000sub0]\nDefaultValue=1\n\n[2000subFF]\nDefaultValue=7\n");
}

TEST_CASE("merge: storage group and TPDO trigger in comments are merged like other values") {
  CHECK(merged("[2000]\nParameterName=a\n\n[2001]\nParameterName=b\n;StorageLocation=RAM\n",
               "[2000]\nLowLimit=0\n;StorageLocation=ROM\n;TPDODetectCos=1\n[2001]\n; why\n"
               ";StorageLocation=PERSIST\n") ==
        "[2000]\nParameterName=a\nLowLimit=0\n;StorageLocation=ROM\n;TPDODetectCos=1\n\n[2001]\nParameterName=b\n"
        ";StorageLocation=PERSIST\n");
  const Merging merging("[2001]\nParameterName=b\n;StorageLocation=RAM\n", "[2001]\n;StorageLocation=ROM\n");
  REQUIRE(merging.replaced.size() == 1);
  CHECK(merging.replaced[0].key == "StorageLocation");
  CHECK(merging.replaced[0].before == "RAM");
}

TEST_CASE("merge: both spellings of DeviceComissioning are one section") {
  CHECK(merged("[DeviceCommissioning]\nNodeID=5\n", "[DeviceComissioning]\nNodeID=6\nBaudrate=125\n") ==
        "[DeviceCommissioning]\nNodeID=6\nBaudrate=125\n");
  CHECK(merged("[DeviceComissioning]\nNodeID=5\n", "[DeviceCommissioning]\nNodeID=6\n") ==
        "[DeviceComissioning]\nNodeID=6\n");
}

TEST_CASE("merge: a section of very many keys is merged in limited time") {
  std::string base = "[Mine]\n";
  std::string overlay = "[Mine]\n";
  for (int n = 0; n < 100000; ++n) {
    base += "k" + std::to_string(n) + "=1\n";
    overlay += "k" + std::to_string(n + 50000) + "=2\n";
  }
  const std::clock_t begin = std::clock();
  const Merging merging(base, overlay);
  CHECK(merging.replaced.size() == 50000);
  CHECK((std::clock() - begin) / CLOCKS_PER_SEC < 30);  // limit for slow test builds with all checks
}

TEST_CASE("merge: a complete description with another vendor-ID or product code is another product") {
  const auto device = [](const std::string& text) {
    Findings findings;
    return eds::read(eds::Document(Source("a.eds", text), findings), findings).devices.front();
  };
  const std::string type = "[1000]\nParameterName=x\nDataType=7\nAccessType=ro\n";
  const std::string number = "[1018]\nObjectType=9\n[1018sub2]\nDataType=7\nDefaultValue=4\n";
  const Device base = device("[DeviceInfo]\nVendorNumber=0x12\nProductNumber=3\n" + type);
  CHECK(convert::other_product(base, base).empty());
  CHECK(convert::other_product(base, device("[DeviceInfo]\nVendorNumber=0x13\n" + type)) ==
        "vendor number 0x13, the base has 0x12");
  CHECK(convert::other_product(base, device(number + type)) == "product number 0x4, the base has 0x3");
  CHECK(convert::other_product(base, device("[DeviceInfo]\nProductNumber=4\n")).empty());  // a value of a build
  CHECK(convert::other_product(base, device("[DeviceInfo]\nProductNumber=0\n" + type)).empty());
}

TEST_CASE("commission: node-ID, bit rate and name of a DCF are set and no other byte changes") {
  Findings findings;
  const auto commissioned = [&findings](const std::string& dcf, const convert::NodeSettings& settings) {
    std::string bytes;
    CHECK(convert::commission(settings, eds::Document(Source("a.dcf", dcf), findings), bytes));
    return bytes;
  };
  convert::NodeSettings settings;
  settings.node_id = std::uint8_t{5};
  settings.bit_rate = 0U;
  settings.node_name = "Inlet";
  CHECK(commissioned("; Mine\n[DeviceComissioning]\nNodeID = 3\nNodeName=Old\nBaudrate=\n[1000]\n", settings) ==
        "; Mine\n[DeviceComissioning]\nNodeID = 5\nNodeName=Inlet\nBaudrate=0\n[1000]\n");
  settings.bit_rate = std::nullopt;
  settings.node_name = std::nullopt;
  CHECK(commissioned("[FileInfo]\nFileName=x\n", settings) ==
        "[FileInfo]\nFileName=x\n\n[DeviceComissioning]\nNodeID=5\n");
  settings.node_name = "two\n[1000]";
  CHECK(convert::fault_of(settings).find("line end") != std::string::npos);
}
