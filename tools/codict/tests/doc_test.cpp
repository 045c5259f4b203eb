// SPDX-License-Identifier: Apache-2.0
// Documentation of a device, as Markdown and as a page.
#include "doc/doc.hpp"

#include <doctest/doctest.h>

#include <string>

#include "doc/contents.hpp"
#include "doc/picture.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "program.hpp"
#include "xdd_reading.hpp"

using lexican::codict::Device;
using lexican::codict::Findings;
using lexican::codict::Source;
using namespace lexican::codict::doc;
using test::has;

namespace {

Device device_of(const std::string& eds) {
  Findings findings;
  const lexican::codict::eds::Document document(Source("device.eds", eds), findings);
  return lexican::codict::eds::read(document, findings).devices.front();
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

const std::string drive =
    "[DeviceInfo]\nVendorName=Ends & Means\nProductName=Drive <7>\nBaudRate_125=1\nBaudRate_250=0\nNrOfTXPDO=1\n"
    "[1014]\nParameterName=COB-ID EMCY\nObjectType=7\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x80\n"
    "[1800]\nParameterName=TPDO 1\nObjectType=9\nSubNumber=3\n"
    "[1800sub0]\nParameterName=Highest\nDataType=5\nAccessType=const\nDefaultValue=2\n"
    "[1800sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x180\n"
    "[1800sub2]\nParameterName=Type\nDataType=5\nAccessType=rw\nDefaultValue=3\n"
    "[1A00]\nParameterName=TPDO 1 mapping\nObjectType=9\nSubNumber=5\n"
    "[1A00sub0]\nParameterName=Number\nDataType=5\nAccessType=rw\nDefaultValue=3\n"
    "[1A00sub1]\nParameterName=First\nDataType=7\nAccessType=rw\nDefaultValue=0x20000010\n"
    "[1A00sub2]\nParameterName=Second\nDataType=7\nAccessType=rw\nDefaultValue=0x20010104\n"
    "[1A00sub3]\nParameterName=Third\nDataType=7\nAccessType=rw\nDefaultValue=0x00050008\n"
    "[1A00sub4]\nParameterName=Not in force\nDataType=7\nAccessType=rw\nDefaultValue=0x20000010\n"
    "[2000]\nParameterName=Speed|*x*\nObjectType=7\nDataType=0x0003\nAccessType=rwr\nDefaultValue=5\n"
    "LowLimit=-10\nHighLimit=10\nPDOMapping=1\n"
    "[2001]\nParameterName=States\nObjectType=8\nSubNumber=2\n"
    "[2001sub0]\nParameterName=Highest\nDataType=5\nAccessType=const\nDefaultValue=1\n"
    "[2001sub1]\nParameterName=State <b>\nDataType=5\nAccessType=ro\nPDOMapping=1\n";

Options for_node(std::uint8_t node_id) {
  Options options;
  options.node_id = node_id;
  return options;
}

}  // namespace

TEST_CASE("doc: the supported features and bit rates of a device are listed") {
  const std::string text = markdown(device_of(drive), {});
  CHECK(has(text, "# Drive \\<7\\>\n"));
  CHECK(has(text, "| Vendor | Ends \\& Means |"));
  CHECK(has(text, "| Bit rates | 125 kbit/s |"));
  CHECK(has(text, "| TPDOs | 1 |"));
}

TEST_CASE("doc: COB-IDs have the requested node-ID added") {
  const std::string text = markdown(device_of(drive), for_node(5));
  CHECK(has(text, "## <a id=\"cob-ids\"></a>COB-IDs of node 5"));
  CHECK(has(text, "| 705h | Heartbeat | CiA 301 |"));
  CHECK(has(text, "| 605h | SDO server 1, request | CiA 301 |"));
  CHECK(has(text, "| 085h | EMCY | 1014h |"));
  CHECK(has(text, "| 185h | TPDO 1 | 1800h:1 |"));
}

TEST_CASE("doc: a COB-ID that is off or missing is shown as such; bit 31 of SYNC is ignored") {
  const auto cob_id = [](const char* index, const char* value) {
    const Device device =
        device_of("[" + std::string(index) +
                  "]\nParameterName=x\nObjectType=7\nDataType=7\nAccessType=rw\nDefaultValue=" + value + "\n");
    return contents_of(device, {}).cob_ids.back().identifier;
  };
  CHECK(cob_id("1014", "0x80000081") == "off");
  CHECK(cob_id("1014", "0x81") == "081h");
  CHECK(cob_id("1014", "0x20000081") == "081h");
  CHECK(cob_id("1014", "0x21234567") == "1234567h");
  CHECK(cob_id("1014", "") == "?");
  CHECK(cob_id("1005", "0xC0000080") == "080h");
  CHECK(cob_id("1012", "0x80000100") == "100h");
}

TEST_CASE("doc: the objects of a PDO are listed with their bits, up to its number of mapped objects") {
  const Contents contents = contents_of(device_of(drive), {});
  REQUIRE(contents.pdos.size() == 1);
  const PdoItem& pdo = contents.pdos.front();
  CHECK(pdo.title == "TPDO 1");
  CHECK(pdo.cob_id == "$NODEID+0x180");
  CHECK(pdo.transmission == "once every 3 SYNCs");
  CHECK(pdo.bits == 28);
  REQUIRE(pdo.parts.size() == 3);
  CHECK(pdo.parts[0].number == "2000h");
  CHECK(pdo.parts[0].first_bit == 0);
  CHECK(pdo.parts[1].number == "2001h:1");
  CHECK(pdo.parts[1].first_bit == 16);
  CHECK(pdo.parts[1].bits == 4);
  CHECK(pdo.parts[2].name == "not used");
}

TEST_CASE("doc: the picture of a PDO has a box for each byte of each object") {
  const std::string svg = picture_of(contents_of(device_of(drive), {}).pdos.front());
  // The object of 16 bits has two boxes, that of 4 bits one, the dummy object of 8 bits from bit 20 on two.
  CHECK(occurrences(svg, "<rect ") == 5);
  CHECK(occurrences(svg, "data-object=\"2000h\"") == 2);
  CHECK(occurrences(svg, "data-object=\"2001h:1\"") == 1);
  CHECK(occurrences(svg, "data-object=\"0005h:0\"") == 2);
  CHECK(has(svg, "2001h:1 State &lt;b&gt;"));
}

TEST_CASE("doc: the picture of a mapping of more than 64 bits has 64") {
  PdoItem pdo;
  pdo.parts.push_back({"2000h", "", "x", 0, 255});
  pdo.bits = 255;
  CHECK(occurrences(picture_of(pdo), "<rect ") == 8);
}

TEST_CASE("doc: texts of a description are escaped for Markdown and HTML") {
  const Device device = device_of(drive);
  CHECK(has(markdown(device, {}), "Speed\\|\\*x\\*"));
  const std::string page = html(device, {});
  CHECK(has(page, "<title>Drive &lt;7&gt;</title>"));
  CHECK(has(page, "Ends &amp; Means"));
  CHECK(has(page, "State &lt;b&gt;"));
  CHECK_FALSE(has(page, "State <b>"));
  CHECK(escaped_html("a\"b'c\x01") == "a&quot;b&#39;c ");
}

TEST_CASE("doc: objects have stable anchors with their indices") {
  const std::string page = html(device_of(drive), {});
  CHECK(has(page, "id=\"o-2000\""));
  CHECK(has(page, "id=\"o-2001-1\""));
  CHECK(has(markdown(device_of(drive), {}), "<a id=\"o-2001-1\"></a>2001h:1"));
}

TEST_CASE("doc: chapters are the areas of the object dictionary") {
  const Contents contents = contents_of(device_of(drive), {});
  REQUIRE(contents.chapters.size() == 2);
  CHECK(contents.chapters[0].title == "Communication profile");
  CHECK(contents.chapters[0].objects.size() == 3);
  CHECK(contents.chapters[1].title == "Manufacturer-specific objects");
  CHECK(contents.chapters[1].objects.size() == 2);
}

TEST_CASE("doc: groups of the description are chapters, and an object is in one chapter only") {
  Device device = device_of(drive);
  device.find(0x2000)->parameter_id.edit().text = "UID_speed";
  lexican::codict::Group inner;
  inner.id.text = "inner";
  inner.parameters.push_back({"UID_speed", {}, true});
  lexican::codict::Group outer = inner;
  outer.id.text = "outer";
  outer.groups.push_back(inner);
  device.groups.push_back(outer);
  const Contents contents = contents_of(device, {});
  REQUIRE(contents.chapters.size() == 4);
  CHECK(contents.chapters[0].title == "outer");
  REQUIRE(contents.chapters[0].objects.size() == 1);
  CHECK(contents.chapters[0].objects[0].object.number == "2000h");
  CHECK(contents.chapters[1].title == "inner");
  CHECK(contents.chapters[1].level == 1);
  CHECK(contents.chapters[1].objects.empty());
  CHECK(contents.chapters[3].objects.size() == 1);
}

TEST_CASE("doc: an object has its type, access, mapping, default and range") {
  const Contents contents = contents_of(device_of(drive), {});
  const Item& speed = contents.chapters[1].objects[0].object;
  CHECK(speed.type == "INTEGER16");
  CHECK(speed.access == "rwr");
  CHECK(speed.mapping == "TPDO");
  CHECK(speed.default_value == "5");
  CHECK(speed.range == "-10 … 10");
}

TEST_CASE("doc: an object has its storage group, a sub-object only one that it names") {
  const std::string group = "\n;StorageLocation=";
  const Device device = device_of("[2000]\nParameterName=a\nObjectType=9" + group + "PERSIST_COMM\n[2000sub1]" + group +
                                  "RAM\n[2000sub2]" + group + "PERSIST_APP\n[2001]" + group + "RAM\n");
  const Contents contents = contents_of(device, {});
  const ObjectItem& first = contents.chapters[0].objects[0];
  CHECK(first.object.group == "PERSIST_COMM");
  CHECK(first.subs.at(0).group == "");
  CHECK(first.subs.at(1).group == "PERSIST_APP");
  CHECK(contents.chapters[0].objects[1].object.group == "");
}

TEST_CASE("doc: an enumeration lists its values with names, a string its capacity") {
  const test::XmlReading xdd = test::fixture_xml("enumeration.xdd");
  const std::string text = markdown(xdd.device, for_node(1));
  CHECK(has(text, "0: off. 1: on."));
  CHECK(has(text, "Has room for 16 characters."));
  CHECK(has(text, "Has room for 12 bytes."));
  const std::string page = html(xdd.device, for_node(1));
  CHECK(has(page, "<br>0: off<br>1: on"));
  CHECK(has(page, "Has room for 16 characters."));
}

TEST_CASE("doc: the same device gives the same page byte for byte") {
  CHECK(html(device_of(drive), {}) == html(device_of(drive), {}));
  CHECK(html(device_of(""), {}) == html(device_of(""), {}));
}

TEST_CASE("doc: the frames of SRDOs and the global fail-safe command are listed") {
  const std::string text =
      markdown(device_of("[1300]\nParameterName=GFC\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=1\n"
                         "[1302]\nParameterName=SRDO\nObjectType=9\nSubNumber=3\n"
                         "[1302sub1]\nParameterName=Direction\nDataType=5\nAccessType=rw\nDefaultValue=2\n"
                         "[1302sub5]\nParameterName=COB-ID 1\nDataType=7\nAccessType=rw\nDefaultValue=0x107\n"
                         "[1302sub6]\nParameterName=COB-ID 2\nDataType=7\nAccessType=rw\nDefaultValue=0x108\n"),
               for_node(5));
  CHECK(has(text, "| 001h | GFC | 1300h |\n"));
  CHECK(has(text, "| 107h | SRDO 2 received, plain | 1302h:5 |\n"));
  CHECK(has(text, "| 108h | SRDO 2 received, inverse | 1302h:6 |\n"));
}
