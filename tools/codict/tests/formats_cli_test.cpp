// SPDX-License-Identifier: Apache-2.0
// Commands of codict that convert, merge, compare or generate, run as a program.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "reading.hpp"

using test::bytes_of;
using test::Directory;
using test::has;
using test::Ran;
using test::run;
using Json = nlohmann::json;

TEST_CASE("codict convert: JSON contains all information of the other formats and converts back") {
  const Directory directory;
  const std::string json = directory / "device.json";
  const std::string again = directory / "device10.xdd";
  const Ran ran = run("convert --strict-loss xdd/device10.xdd -o " + json);
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  CHECK(Json::parse(bytes_of(json)).at("schema") == "codict-device-1");
  CHECK(run("diff xdd/device10.xdd " + json).status == 0);
  CHECK(run("convert " + json + " --to xdc -o " + again).status == 0);
  CHECK(run("diff xdd/device10.xdd " + again).status == 0);
  CHECK(run("convert " + json + " --to json -o -").out == bytes_of(json));
  CHECK(run("convert commissioning.dcf --to json -o - | '" LEXICAN_CODICT_PROGRAM
            "' convert - --to dcf -o - | '" LEXICAN_CODICT_PROGRAM "' diff - commissioning.dcf --only configuration")
            .status == 0);
}

TEST_CASE("codict set: an output with the suffix of another format is refused") {
  const Directory directory;
  const Ran xml = run("set xdd/device10.xdd 2000 default=1 -o " + directory / "device.eds");
  CHECK(xml.status == 2);
  CHECK(has(xml.err, "device.eds: xdd/device10.xdd has another format; use convert to change the format\n"));
  CHECK(run("set drive.eds 2000 default=1 -o " + directory / "drive.xdd").status == 2);
  CHECK(run("set drive.eds 2000 default=1 -o " + directory / "drive.json").status == 2);
  CHECK_FALSE(std::filesystem::exists(directory / "drive.xdd"));
  CHECK(run("set drive.eds 2000 default=1 -o " + directory / "drive.dcf").status == 0);
  CHECK(run("set drive.eds 2000 default=1 -o " + directory / "drive.txt").status == 0);
}

TEST_CASE("codict: a failure message contains the request") {
  const Directory directory;
  CHECK(has(run("get xdd/device10.xdd FileInfo").err, "no object: FileInfo; only an EDS or DCF has sections\n"));
  CHECK(has(run("merge drive.eds --set version=1.2 -o " + directory / "drive.eds").err,
            "--set version=1.2: object 100A:00 does not exist\n"));
  CHECK(has(run("merge drive.eds --set nonsense=1 -o " + directory / "drive.eds").err,
            "--set nonsense=1: neither a word (vendor,"));
}

TEST_CASE("codict convert: the JSON of an EDS converts to an equivalent EDS with other bytes") {
  const Directory directory;
  CHECK(run("convert drive.eds -o " + directory / "drive.json").status == 0);
  CHECK(run("convert " + directory / "drive.json" + " -o " + directory / "drive.eds").status == 0);
  CHECK(has(bytes_of(directory / "drive.eds"), "[FileInfo]\r\nFileName=drive.eds\r\n"));
  CHECK(run("diff drive.eds " + directory / "drive.eds").status == 0);
}

TEST_CASE("codict: all commands that read descriptions read JSON") {
  const Directory directory;
  const std::string json = directory / "drive.json";
  REQUIRE(run("convert drive.eds -o " + json).status == 0);
  CHECK(run("check --level note " + json).out.empty());
  CHECK(has(run("info " + json).out, "Format           JSON, EDS\n"));
  CHECK(run("list " + json).out == run("list drive.eds").out);
  CHECK(run("get " + json + " 1018:1 default").out == run("get drive.eds 1018:1 default").out);
  CHECK(run("doc --to md " + json + " -o -").out == run("doc --to md drive.eds -o -").out);
  CHECK(run("gen " + json + " -o " + directory / "made").status == 0);
  CHECK(has(bytes_of(directory / "made/drive_od.h"), "drive_od"));
  const Json place = Json::parse(run("get --json " + json + " 1018:1 default").out).at("keys").at(0);
  CHECK(place.at("line") > 10);
  const Ran refused = run("set " + json + " 1018:1 default=3");
  CHECK(refused.status == 2);
  CHECK(refused.err == "codict: " + json + ": values of JSON are changed by programs for JSON\n");
}

TEST_CASE("codict: JSON that is not a description is refused with one message with line and column") {
  const Directory directory;
  const std::string path = directory / "other.json";
  test::write_bytes(path, "{\n  \"schema\": \"codict-check-1\"\n}\n");
  const Ran other = run("check " + path);
  CHECK(other.status == 2);
  CHECK(other.out.empty());
  CHECK(other.err == "codict: " + path +
                         ": line 2, column 14: codict-check-1 is the output of a command, no device description, which "
                         "has \"schema\": "
                         "\"codict-device-1\"\n");
  test::write_bytes(path, "{\n  \"schema\"\n}\n");
  const Ran malformed = run("info " + path);
  CHECK(malformed.status == 2);
  CHECK(has(malformed.err, path + ": line 3, column 1: this is no JSON"));
  CHECK(std::count(malformed.err.begin(), malformed.err.end(), '\n') == 1);
}

TEST_CASE("codict check: findings in JSON have their line and a caret") {
  const Directory directory;
  const std::string path = directory / "device.json";
  test::write_bytes(path, R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [
  {"index": 8192, "name": "x", "object_code": "var", "data_type": 5, "access": "rw", "default_value": "300"}
]}]}
)");
  const Ran ran = run("check " + path);
  CHECK(ran.status == 1);
  CHECK(has(ran.out, ":2:104: error: 2000h 'x': '300' does not fit UNSIGNED8 (0 to 255) [od-value-range]\n"));
  CHECK(has(ran.out, std::string(103, ' ') + "    ^~~\n"));
  CHECK_FALSE(has(run("check --disable json-type " + path).err, "unknown rule"));
}

namespace {

std::string overlay(const Directory& directory, const char* name, const std::string& text) {
  test::write_bytes(directory / name, text);
  return directory / name;
}

}  // namespace

TEST_CASE("codict merge: overlays of any format are applied in order, with values of a build") {
  const Directory directory;
  const std::string first = overlay(directory, "first.eds", "[2000]\nDefaultValue=7\nLowLimit=1\n");
  const std::string second = overlay(directory, "second.json", R"({"schema": "codict-device-1", "devices": [
{"format": "eds", "objects": [{"index": 8448, "name": "New", "object_code": "var", "data_type": 6, "access": "rw", "default_value": 9}]}]})");
  const std::string out = directory / "out.eds";
  const Ran ran = run("merge drive.eds " + first + " " + second +
                      " --set product=8 --set FileInfo.ModifiedBy=me --set 2001:1.name=Place -o " + out);
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  CHECK(run("get " + out + " 2000 default").out == "7\n");
  CHECK(run("get " + out + " 2000 low").out == "1\n");
  CHECK(run("get " + out + " 2100 name").out == "New\n");
  CHECK(run("get " + out + " 1018:2 default").out == "8\n");
  CHECK(run("get " + out + " DeviceInfo ProductNumber").out == "8\n");
  CHECK(run("get " + out + " FileInfo ModifiedBy").out == "me\n");
  CHECK(run("get " + out + " 2001:1 name").out == "Place\n");
  CHECK(run("check --level warning " + out).out.empty());
  CHECK(run("merge drive.eds -o -").out == bytes_of(test::fixture("drive.eds")));
}

TEST_CASE("codict merge: overlays that contradict the base or one another are reported") {
  const Directory directory;
  const std::string first = overlay(directory, "first.eds", "[2000]\nDefaultValue=7\nDataType=0x0007\n");
  const std::string second = overlay(directory, "second.eds", "[2000]\nDefaultValue=8\n");
  const Ran ran = run("merge --force --json drive.eds " + first + " " + second + " -o " + directory / "out.eds");
  CHECK(ran.status == 0);
  CHECK(has(ran.err, "codict: " + first + ": [2000] DataType=0x0007 contradicts 0x0003 of drive.eds\n"));
  CHECK(has(ran.err, "codict: " + second + ": [2000] DefaultValue=8 contradicts 7 of " + first + "\n"));
  CHECK_FALSE(has(ran.err, "DefaultValue=7 contradicts"));
  const Json json = Json::parse(ran.out);
  CHECK(json.at("schema") == "codict-merge-1");
  CHECK(json.at("replaced").size() == 3);
  CHECK(json.at("replaced").at(2).at("by") == second);
}

TEST_CASE("codict merge: input that cannot be merged is reported and nothing is written") {
  const Directory directory;
  const std::string out = directory / "out.eds";
  CHECK(run("merge drive.eds missing.eds -o " + out).status == 2);
  CHECK(run("merge drive.eds -o " + out + " --set serial=5").err ==
        "codict: --set serial=5: object 1018:04 does not exist\n");
  CHECK(run("merge drive.eds -o " + out + " --set colour=5").status == 2);
  CHECK(run("merge drive.eds -o " + out + " --set 1018:1").status == 2);
  CHECK(run("merge xdd/device10.xdd -o " + out).err ==
        "codict: xdd/device10.xdd: the base must be an EDS or DCF; use convert first, or set to change values of an "
        "XDD\n");
  const Ran wrong = run("merge drive.eds -o " + out + " --set 2000.default=70000");
  CHECK(wrong.status == 1);
  CHECK(has(wrong.err, "od-value-range"));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("codict fmt: a file is rewritten in its normal form; --check returns whether it would change") {
  const Directory directory;
  const std::string path = test::copy_to(directory, "section_form.eds");
  const Ran no = run("fmt --check " + path);
  CHECK(no.status == 1);
  CHECK(no.err == "codict: " + path + " is not in normal form\n");
  CHECK(bytes_of(path) == bytes_of(test::fixture("section_form.eds")));
  CHECK(run("fmt " + path).status == 0);
  CHECK(run("fmt --check " + path).status == 0);
  CHECK(run("fmt section_form.eds -o -").out == bytes_of(path));
  CHECK(Json::parse(run("fmt --check --json section_form.eds").out).at("changed") == true);
  CHECK(Json::parse(run("fmt --json " + path).out).at("changed") == false);
  CHECK(run("fmt drive.eds --check").status == 0);
  CHECK(run("fmt xdd/device10.xdd --check").err ==
        "codict: xdd/device10.xdd: not an EDS or DCF; fmt has no normal form for other formats\n");
  CHECK(run("fmt missing.eds").status == 2);
}

TEST_CASE("codict size: prints RAM and flash of the generated dictionary") {
  const Directory directory;
  const std::string sizes = run("size gen/small.eds").out;
  CHECK(sizes ==
        "part                  entries      RAM    flash\n"
        "RAM                         1        1        1\n"
        "DRIVE                       2       64      100\n"
        "table                      10        0      120\n"
        "limits                      1        0      286\n"
        "stored types                1        0      150\n"
        "all                                 65      657\n");
  CHECK(has(run("size gen/every_kind.eds").out, "\nPERSIST_COMM               22      116      152\n"));
  CHECK(run("gen gen/small.eds --report -o " + directory / "made").out.rfind(sizes, 0) ==
        0);  // followed by the list of externals
  const Json json = Json::parse(run("size --json gen/small.eds").out);
  CHECK(json.at("schema") == "codict-size-1");
  CHECK(json.at("parts").at(0).at("part") == "RAM");
  const Ran wrong = run("size octets.eds");
  CHECK(wrong.status == 1);
  CHECK(wrong.out.empty());
  CHECK(has(wrong.err, "[gen-"));
  CHECK(run("size missing.eds").status == 2);
}

TEST_CASE("codict pdo: prints the objects of each PDO, their bits and the transmission") {
  const Ran ran = run("pdo --node-id 5 drive.eds");
  CHECK(ran.status == 0);
  CHECK(ran.out == R"(RPDO 1: COB-ID 205h; by events of the device profile; 24 bits
  byte  7 6 5 4 3 2 1 0
     0  A A A A A A A A
     1  B B B B B B B B
     2  B B B B B B B B
  A  0005h:0   8 bits from 0  not used
  B  2000h     16 bits from 8  Wanted speed

TPDO 1: COB-ID 185h; by events of the manufacturer; 40 bits
  byte  7 6 5 4 3 2 1 0
     0  A A A A A A A A
     1  A A A A A A A A
     2  A A A A A A A A
     3  A A A A A A A A
     4  B B B B B B B B
  A  2001h:1   32 bits from 0  Position <encoder>
  B  1001h     8 bits from 32  Error register
)");
  CHECK(run("pdo --node-id 128 drive.eds").status == 2);
  CHECK(run("pdo octal.eds").out.empty());
}

TEST_CASE("codict pdo: times are printed, bits across bytes are drawn, and JSON has all of it") {
  const Directory directory;
  const std::string path = directory / "bits.eds";
  test::write_bytes(path,
                    "[1800]\nParameterName=TPDO\nObjectType=9\nSubNumber=5\n"
                    "[1800sub0]\nParameterName=n\nDataType=5\nAccessType=const\nDefaultValue=6\n"
                    "[1800sub1]\nParameterName=c\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x80000180\n"
                    "[1800sub3]\nParameterName=i\nDataType=6\nAccessType=rw\nDefaultValue=25\n"
                    "[1800sub5]\nParameterName=e\nDataType=6\nAccessType=rw\nDefaultValue=100\n"
                    "[1800sub6]\nParameterName=s\nDataType=5\nAccessType=rw\nDefaultValue=3\n"
                    "[1A00]\nParameterName=M\nObjectType=9\nSubNumber=3\n"
                    "[1A00sub0]\nParameterName=n\nDataType=5\nAccessType=const\nDefaultValue=2\n"
                    "[1A00sub1]\nParameterName=m\nDataType=7\nAccessType=const\nDefaultValue=0x20000003\n"
                    "[1A00sub2]\nParameterName=m\nDataType=7\nAccessType=const\nDefaultValue=0x20010008\n");
  CHECK(run("pdo " + path).out ==
        "TPDO 1: COB-ID off; inhibit time 2.5 ms; event time 100 ms; from SYNC 3 on; 11 bits\n"
        "  byte  7 6 5 4 3 2 1 0\n"
        "     0  B B B B B A A A\n"
        "     1  . . . . . B B B\n"
        "  A  2000h:0   3 bits from 0  not described\n"
        "  B  2001h:0   8 bits from 3  not described\n");
  const Json json = Json::parse(run("pdo --json --node-id 2 " + path).out);
  CHECK(json.at("schema") == "codict-pdo-1");
  const Json& pdo = json.at("pdos").at(0);
  CHECK(pdo.at("cob_id") == 0x182);
  CHECK(pdo.at("valid") == false);
  CHECK(pdo.at("inhibit_time_100us") == 25);
  CHECK(pdo.at("event_time_ms") == 100);
  CHECK(pdo.at("sync_start") == 3);
  CHECK(pdo.at("mapped").at(1).at("first_bit") == 3);
  CHECK(pdo.at("mapped").at(1).at("index") == 0x2001);
}

TEST_CASE("codict pdo, codict doc: without --node-id COB-IDs use the configured node-ID") {
  CHECK(has(run("pdo xdd/device10.xdd").out, "TPDO 1: COB-ID 185h"));
  CHECK(has(run("pdo --node-id 2 xdd/device10.xdd").out, "TPDO 1: COB-ID 182h"));
  CHECK(has(run("doc xdd/device10.xdd --to md -o -").out, "COB-IDs of node 5\n"));
  const Directory directory;
  const std::string path = directory / "drive.dcf";
  const auto with = [&path](const char* node_id) {
    test::write_bytes(path, bytes_of(test::fixture("drive.eds")) + "[DeviceComissioning]\nNodeID=" + node_id + "\n");
    return Json::parse(run("pdo --json " + path).out).at("node_id");
  };
  CHECK(with("0x7F") == 127);
  CHECK(with("128") == 1);
  CHECK(with("0") == 1);
}

TEST_CASE("codict set: an element of compact storage gets a list entry and the list a new count [306: 4.6.4]") {
  const Directory directory;
  const std::string path = test::copy_to(directory, "compact.dcf");
  REQUIRE(run("get " + path + " 2000Value NrOfEntries").status == 0);
  const std::string before = bytes_of(path);
  CHECK(run("set " + path + " 2000:5 value=9 name=Fifth").status == 0);
  CHECK(run("get " + path + " 2000Value 5").out == "9\n");
  CHECK(run("get " + path + " 2000Name 5").out == "Fifth\n");
  CHECK(has(run("list " + path).out, "Fifth\n"));
  CHECK_FALSE(has(run("check " + path).out, "2000Value"));
  const std::string once = bytes_of(path);
  CHECK(run("set " + path + " 2000:5 value=8").status == 0);
  CHECK(bytes_of(path).size() == once.size());
  const Ran refused = run("set " + path + " 2000:5 access=ro");
  CHECK(refused.status == 2);
  CHECK(refused.err ==
        "codict: " + path + ": 2000:05 is in compact storage, where only name, value and denotation can be set\n");
  CHECK(run("set " + path + " 2000:5 value=70000000000").status == 1);
}

namespace {

// Object whose data type is an element of its parameter.
const char* const typed_by_parameter =
    R"(<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.0"><ISO15745Profile><ProfileBody>
<DeviceIdentity/><ApplicationProcess><parameterList>
<parameter uniqueID="P" access="readWrite"><label lang="en">x</label><USINT/></parameter>
</parameterList></ApplicationProcess></ProfileBody></ISO15745Profile><ISO15745Profile><ProfileBody><ApplicationLayers>
<CANopenObjectList><CANopenObject index="2000" name="x" objectType="7" uniqueIDRef="P"/></CANopenObjectList>
</ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>
)";

}  // namespace

TEST_CASE("codict set: a value missing in an XDD is added as an attribute of its object") {
  const Directory directory;
  const std::string path = directory / "device.xdd";
  test::write_bytes(path, typed_by_parameter);
  std::string wanted = typed_by_parameter;
  const auto add = [&wanted](const std::string& attribute) {
    wanted.insert(wanted.find("/></CANopenObjectList>"), " " + attribute);
  };
  CHECK(run("set " + path + " 2000 default=5 high=9").status == 0);
  add("defaultValue=\"5\" highLimit=\"9\"");
  CHECK(bytes_of(path) == wanted);
  CHECK(run("get " + path + " 2000 default").out == "5\n");
  CHECK(run("set " + path + " 2000 'denotation=a < b'").status == 0);
  add("denotation=\"a &lt; b\"");
  CHECK(bytes_of(path) == wanted);
  CHECK(run("set " + path + " 2000 colour=red").status == 2);
  CHECK(run("set " + path + " 2000 value=256").status == 1);
  CHECK(bytes_of(path) == wanted);
}

TEST_CASE("codict set: properties of CANopenNode are set in an XDD, and in comments of an EDS") {
  const Directory directory;
  const std::string eds = copy_to(directory, "drive.eds");
  std::string wanted = bytes_of(eds);
  const std::size_t section = wanted.find("[2000]");
  REQUIRE(section != std::string::npos);
  const std::size_t end = wanted.find("\n\n", section);
  wanted.insert(end, "\n;StorageLocation=PERSIST_APP\n;TPDODetectCos=1");
  CHECK(run("set " + eds + " 2000 CO_storageGroup=PERSIST_APP CO_flagsPDO=true").status == 0);
  CHECK(bytes_of(eds) == wanted);
  CHECK(run("set " + eds + " 2000 TPDODetectCos=1").status == 0);
  CHECK(bytes_of(eds) == wanted);
  CHECK(run("get " + eds + " 2000 CO_storageGroup").out == "PERSIST_APP\n");
  const Ran refused = run("set " + eds + " 2000 CO_extensionIO=true");
  CHECK(refused.status == 2);
  CHECK(has(refused.err, "an EDS or DCF cannot express CO_extensionIO: convert it to XDD"));

  const std::string xdd = directory / "drive.xdd";
  CHECK(run("convert " + eds + " -o " + xdd).status == 0);
  std::string changed = bytes_of(xdd);
  CHECK(has(changed, "<co:property name=\"CO_flagsPDO\" value=\"true\"/>"));
  {
    const std::string commented = directory / "commented.xdd";
    std::string bytes = changed;
    bytes.insert(bytes.find("</co:parameter>", bytes.find("\"UID_OBJ_1017\"")), "<!-- </co:parameter> -->");
    std::ofstream(commented, std::ios::binary) << bytes;
    CHECK(run("set " + commented + " 1017 CO_extensionIO=true").status == 0);
    CHECK(run("get " + commented + " 1017 CO_extensionIO").out == "true\n");
  }
  const std::size_t begin = changed.find("</co:parameter>", changed.find("\"UID_OBJ_1017\""));
  const std::size_t line = changed.rfind('\n', begin);
  const std::string indent = changed.substr(line, begin - line) + "  ";
  changed.insert(line, indent + "<co:property name=\"CO_storageGroup\" value=\"PERSIST_COMM\"/>" + indent +
                           "<co:property name=\"CO_extensionIO\" value=\"true\"/>");
  changed.replace(changed.find("PERSIST_APP"), 11, "PERSIST_MFR");
  CHECK(run("set " + xdd + " 1017 StorageLocation=PERSIST_COMM CO_extensionIO=1 2000 CO_storageGroup=PERSIST_MFR")
            .status == 0);
  CHECK(bytes_of(xdd) == changed);
  CHECK(run("get " + xdd + " 1017 CO_extensionIO").out == "true\n");
  CHECK(run("check " + xdd).status == 0);
  CHECK(has(run("set " + xdd + " 1018 CO_storageGroup=A").err, "no parameter (uniqueIDRef) for CO_storageGroup"));
  CHECK(bytes_of(xdd) == changed);
}

TEST_CASE("codict set: several targets are changed in one call, or none") {
  const Directory directory;
  const std::string eds = copy_to(directory, "drive.eds");
  const std::string before = bytes_of(eds);
  CHECK(run("set " + eds + " 1017 default=5 2000 default=7 FileInfo FileVersion=2").status == 0);
  CHECK(run("get " + eds + " 1017 default").out == "5\n");
  CHECK(run("get " + eds + " 2000 default").out == "7\n");
  CHECK(run("get " + eds + " FileInfo FileVersion").out == "2\n");
  test::write_bytes(eds, before);
  const std::string name = "codict: " + eds;
  CHECK(run("set " + eds + " 1017 default=5 2009 default=7").err == name + ": object 2009 does not exist\n");
  CHECK(run("set " + eds + " 1017 default=5 2000").err == name + ": no field=value for 2000\n");
  CHECK(run("set " + eds + " default=5 2000").err == name + ": no object or section before default=5\n");
  CHECK(run("set " + eds + " 1017 default=5 2000 default=1 default=2").err ==
        name + ": two values for one field: default=2\n");
  CHECK(bytes_of(eds) == before);
}

TEST_CASE("codict set: a type of a parameter is changed there and in the object") {
  const Directory directory;
  const std::string path = directory / "device.xdd";
  test::write_bytes(path, typed_by_parameter);
  std::string wanted = typed_by_parameter;
  const auto replace = [&wanted](const std::string& from, const std::string& to) {
    wanted.replace(wanted.find(from), from.size(), to);
  };
  CHECK(run("get " + path + " 2000 type").out == "USINT\n");
  CHECK(run("set " + path + " 2000 type=0x0006").status == 0);
  replace("<USINT/>", "<UINT/>");
  CHECK(bytes_of(path) == wanted);
  CHECK(run("set " + path + " 2000 datatype=TIME_OF_DAY").status == 0);
  replace("<UINT/>", "<BITSTRING/>");
  replace(" uniqueIDRef=\"P\"/>", " uniqueIDRef=\"P\" dataType=\"0C\"/>");
  CHECK(bytes_of(path) == wanted);
  CHECK(run("set " + path + " 2000 type=UNSIGNED32").status == 0);
  replace("<BITSTRING/>", "<UDINT/>");
  replace("dataType=\"0C\"", "dataType=\"07\"");
  CHECK(bytes_of(path) == wanted);
  CHECK(has(run("list " + path).out, "2000     UNSIGNED32 "));
  replace("<UDINT/>", "<x:UDINT xmlns:x=\"urn:x\"> </x:UDINT>");
  test::write_bytes(path, wanted);
  CHECK(run("set " + path + " 2000 type=5").status == 0);
  replace("<x:UDINT xmlns:x=\"urn:x\"> </x:UDINT>", "<x:USINT xmlns:x=\"urn:x\"> </x:USINT>");
  replace("dataType=\"07\"", "dataType=\"05\"");
  CHECK(bytes_of(path) == wanted);
}

TEST_CASE("codict set: a type that others may share is refused with the reason") {
  const Directory directory;
  const std::string path = copy_to(directory, "xdd/device10.xdd");
  CHECK(run("set " + path + " 2000 type=06").err ==
        "codict: " + path +
            ": the type is that of the data type T_MODE, which others may use, too: it is not changed\n");
  CHECK(run("set " + path + " 2000 type=06").status == 1);
  CHECK(has(run("set " + path + " 2002:1 type=06").err, "the template TPL_RO"));
  const Ran wrong = run("set " + path + " 1000 type=COLOUR");
  CHECK(wrong.status == 1);
  CHECK(wrong.err == "codict: " + path + ": this is no data type of CiA 301: COLOUR\n");
  CHECK(bytes_of(path) == bytes_of(test::fixture("xdd/device10.xdd")));
}

TEST_CASE("codict: no command overwrites its input or writes two outputs to one file") {
  const Directory directory;
  const std::string eds = copy_to(directory, "drive.eds");
  const std::string overlay = directory / "overlay.eds";
  test::write_bytes(overlay, "[1018sub4]\nDefaultValue=5\n");
  const std::string made = " -o " + directory / "made";
  for (const std::string& wrong :
       {"gen " + eds + made + " --eds " + eds, "gen " + eds + made + " --xdd " + directory / "made/drive_od.h",
        "gen " + eds + made + " --eds " + directory / "x" + " --xdd " + directory / "x",
        "convert " + eds + " --to json -o " + eds, "merge " + eds + " " + overlay + " -o " + overlay,
        "check --write-baseline " + eds + " " + overlay}) {
    CAPTURE(wrong);
    CHECK(run(wrong).status == 2);
    CHECK(bytes_of(eds) == bytes_of(test::fixture("drive.eds")));
    CHECK(bytes_of(overlay) == "[1018sub4]\nDefaultValue=5\n");
  }
  CHECK_FALSE(std::filesystem::exists(directory / "made"));
}

TEST_CASE("codict set: two values for one field, and more than one line, are refused") {
  const Directory directory;
  const std::string eds = copy_to(directory, "drive.eds");
  CHECK(run("set " + eds + " 1017 default=1 DefaultValue=2").err ==
        "codict: " + eds + ": two values for one field: DefaultValue=2\n");
  CHECK(run("set " + eds + " 1017 default=1 1017 default=2").err ==
        "codict: " + eds + ": target given twice: 1017; write its fields behind the first\n");
  const std::string dcf = copy_to(directory, "compact.dcf");
  CHECK(run("set " + dcf + " 2000:3 \"value=5\n[2001]\nDownloadFile=x\"").status == 2);
  CHECK(run("merge " + dcf + " -o - --set \"2001.ParamRefd=5\n[2002]\"").status == 2);
  CHECK(bytes_of(eds) == bytes_of(test::fixture("drive.eds")));
  CHECK(bytes_of(dcf) == bytes_of(test::fixture("compact.dcf")));
}

TEST_CASE("codict merge: of an overlay in another format only values of the device are merged") {
  const Directory directory;
  const std::string json = directory / "overlay.json";
  test::write_bytes(json, R"({"schema": "codict-device-1", "devices": [{"format": "xdd11",
    "file": {"file_name": "overlay.xdd"}, "objects": [{"index": 4119, "default_value": 77}]}]})");
  const std::string merged = run("merge drive.eds " + json + " -o -").out;
  CHECK(has(merged, "FileName=drive.eds"));
  CHECK(has(merged, "DefaultValue=77"));
  CHECK_FALSE(has(merged, "DeviceComissioning"));
}

TEST_CASE("codict convert: each edition of CiA 311 is converted to the other one on request") {
  const Directory directory;
  const std::string newer = directory / "newer.xdd";
  const std::string older = directory / "older.xdd";
  CHECK(run("convert xdd/device10.xdd --to xdc -o -").out == bytes_of(test::fixture("xdd/device10.xdd")));
  CHECK(run("convert xdd/device10.xdd --to xdd11 -o " + newer).status == 0);
  CHECK(has(run("info " + newer).out, "Format           XDD 1.1\n"));
  CHECK(run("diff xdd/device10.xdd " + newer + " --only breaking --only compatible").status == 0);
  CHECK(run("diff xdd/device10.xdd " + newer + " --only breaking,compatible").status == 0);
  CHECK(run("diff xdd/device10.xdd " + newer + " --only breaking,none").status == 2);
  CHECK(run("convert " + newer + " --to xdd11 -o -").out == bytes_of(newer));
  CHECK(run("convert " + newer + " --to xdd10 -o " + older).status == 0);
  CHECK(has(run("info " + older).out, "Format           XDD 1.0\n"));
  CHECK(run("diff " + newer + " " + older).out == "file                    file name: newer.xdd -> older.xdd\n");
  CHECK(has(run("convert xdd/device10.xdd --to xdc11 -o -").out, "http://www.canopen.org/xml/1.1"));
  const Ran ran = run("convert xdd/device10.xdd --to xdd11 --strict-loss -o " + directory / "no.xdd");
  CHECK(ran.status == 1);
  CHECK(has(ran.err, "not in the output: "));
  CHECK_FALSE(std::filesystem::exists(directory / "no.xdd"));
}

TEST_CASE("codict convert: values of one device that CiA 311 cannot express are reported") {
  CHECK(has(run("convert compact.dcf --to xdc -o -").err, "1 serial numbers"));
  CHECK_FALSE(has(run("convert compact.dcf --to dcf -o -").err, "serial numbers"));
  CHECK_FALSE(has(run("convert compact.dcf --to xdd -o -").err, "serial numbers"));  // an XDD has no commissioning
}

TEST_CASE("codict convert: further devices and characters that a format cannot contain are reported") {
  const Directory directory;
  const std::string out = directory / "one.eds";
  const Ran several = run("convert xdd/several.nxdd --strict-loss -o " + out);
  CHECK(several.status == 1);
  CHECK(has(several.err, "1 further devices"));
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(run("convert xdd/several.nxdd -o " + out).status == 0);
  CHECK(Json::parse(run("convert xdd/several.nxdd --to json --strict-loss -o -").out).at("devices").size() == 2);
  const std::string json = directory / "nul.json";
  test::write_bytes(json, R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [
  {"index": 8192, "name": "a\u0000b\u0001", "object_code": "var", "data_type": 5, "access": "rw"}]}]})");
  CHECK(has(run("convert " + json + " -o " + out).err, "1 characters that it cannot have"));
  CHECK(run("get " + out + " 2000 name").out ==
        "a\xEF\xBF\xBD"
        "b\x01\n");
  CHECK(has(run("convert " + json + " -o " + directory / "nul.xdd").err, "2 characters that it cannot have"));
  CHECK(run("get " + directory / "nul.xdd" + " 2000 name").out ==
        "a\xEF\xBF\xBD"
        "b\xEF\xBF\xBD\n");
}

TEST_CASE("codict merge: elements of compact storage get their values in lists, like with set") {
  const Directory directory;
  const std::string out = directory / "out.dcf";
  const Ran ran = run("merge compact.dcf --set 2000:5.value=9 --set 2000:5.name=Fifth -o " + out);
  CHECK(ran.status == 0);
  CHECK(run("get " + out + " 2000Value 5").out == "9\n");
  CHECK(run("get " + out + " 2000Name 5").out == "Fifth\n");
  CHECK(has(run("merge compact.dcf --set 2000:5.access=ro -o " + out).err, "2000:05 is in compact storage"));
}

TEST_CASE("codict merge: findings of new parts have their place in the output") {
  const Directory directory;
  const std::string out = directory / "out.eds";
  const Ran ran = run("merge drive.eds --set 2000.default=70000 -o " + out);
  CHECK(ran.status == 1);
  CHECK(has(ran.out + ran.err, out + ":"));
  CHECK_FALSE(has(ran.err, "drive.eds:"));
  CHECK(has(run("merge drive.eds --set 2000.default=70000 -o -").err, "<stdout>:"));
}

TEST_CASE("codict convert: --node-id, --bit-rate and --node-name give the description of one node") {
  const Directory directory;
  const std::string options = " --node-id 5 --bit-rate 250 --node-name \"Inlet valve\"";
  const std::string dcf = directory / "node.dcf";
  CHECK(run("convert drive.eds -o " + dcf + options).status == 0);
  CHECK(run("get " + dcf + " DeviceComissioning NodeID").out == "5\n");
  CHECK(run("get " + dcf + " DeviceComissioning Baudrate").out == "250\n");
  CHECK(run("get " + dcf + " DeviceComissioning NodeName").out == "Inlet valve\n");
  const std::string xdc = directory / "node.xdc";
  CHECK(run("convert " + dcf + " -o " + xdc + " --node-id 6 --bit-rate 0").status == 0);
  CHECK(has(bytes_of(xdc), "nodeID=\"6\" nodeName=\"Inlet valve\" actualBaudRate=\"auto-baudRate\""));
  // Without change of format, nothing else changes.
  const std::string again = directory / "again.dcf";
  CHECK(run("convert " + dcf + " -o " + again + " --node-id 7").status == 0);
  std::string wanted = bytes_of(dcf);
  wanted.replace(wanted.find("NodeID=5"), 8, "NodeID=7");
  CHECK(bytes_of(again) == wanted);
  const std::string other = directory / "other.xdc";
  CHECK(run("convert " + xdc + " -o " + other + " --node-name B").status == 0);
  CHECK(has(bytes_of(other), "nodeID=\"6\" nodeName=\"B\""));
  CHECK(has(run("info " + other).out, "XDC 1.1"));
}

TEST_CASE("codict convert: invalid node settings, or a format without nodes, are refused") {
  const Directory directory;
  const std::string dcf = directory / "node.dcf";
  for (const char* wrong :
       {"--node-id 0", "--node-id 128", "--bit-rate 123", "--bit-rate x", "--node-name \"a\n[1000]\nObjectType=2\""}) {
    CAPTURE(std::string(wrong));
    CHECK(run("convert drive.eds -o " + dcf + " " + wrong).status == 2);
    CHECK_FALSE(std::filesystem::exists(dcf));
  }
  const Ran eds = run("convert compact.dcf -o " + directory / "node.eds" + " --node-id 5");
  CHECK(eds.status == 2);
  CHECK(has(eds.err, "the output must be a DCF, XDC or JSON"));
}

TEST_CASE("codict merge: a description of another product is merged with --force only") {
  const Directory directory;
  const std::string device = "[DeviceInfo]\nVendorNumber=0x12\n[1000]\nParameterName=x\nDataType=7\nAccessType=ro\n";
  test::write_bytes(directory / "a.eds", device);
  test::write_bytes(directory / "b.eds", "[DeviceInfo]\nVendorNumber=0x13\n" + device.substr(device.find("[1000]")));
  const std::string merge = "merge " + directory / "a.eds" + " " + directory / "b.eds" + " -o " + directory / "c.eds";
  const Ran refused = run(merge);
  CHECK(refused.status == 1);
  CHECK(has(refused.err, "vendor number 0x13, the base has 0x12"));
  CHECK_FALSE(std::filesystem::exists(directory / "c.eds"));
  CHECK(run(merge + " --force").status == 0);
  CHECK(has(bytes_of(directory / "c.eds"), "VendorNumber=0x13"));
}

TEST_CASE("codict convert --strict-loss: several ranges cannot become an EDS") {
  const Directory directory;
  const Ran ran = run("convert xdd/ranges.xdd --strict-loss -o " + directory / "a.eds");
  CHECK(ran.status == 1);
  CHECK(has(ran.err, "2 ranges (2000h 1..5, 2000h 10..20)"));
  CHECK_FALSE(std::filesystem::exists(directory / "a.eds"));
}
