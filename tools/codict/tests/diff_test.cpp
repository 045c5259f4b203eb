// SPDX-License-Identifier: Apache-2.0
// Differences between two descriptions, and their kinds.
#include "diff/diff.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd_reading.hpp"

using lexican::codict::Description;
using lexican::codict::Device;
using lexican::codict::Findings;
using lexican::codict::Source;
using namespace lexican::codict::diff;

namespace {

Device device_of(const std::string& eds) {
  Findings findings;
  const lexican::codict::eds::Document document(Source("device.eds", eds), findings);
  return lexican::codict::eds::read(document, findings).devices.front();
}

const std::string speed =
    "[2000]\nParameterName=Speed\nObjectType=7\nDataType=0x0003\nAccessType=rw\nDefaultValue=5\n"
    "LowLimit=-10\nHighLimit=10\nPDOMapping=1\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// Returns a line for each difference: "breaking 2000h access: rw -> ro".
std::vector<std::string> lines(const std::string& before, const std::string& after) {
  std::vector<std::string> result;
  for (const Difference& difference : compare(device_of(before), device_of(after))) {
    const std::string place = to_string(difference.place);
    result.push_back(std::string(name_of(difference.kind)) + (place.empty() ? "" : " ") + place + " " +
                     difference.what + ": " + difference.before + " -> " + difference.after);
  }
  return result;
}

std::string line(const std::string& before, const std::string& after) {
  const std::vector<std::string> all = lines(before, after);
  REQUIRE(all.size() == 1);
  return all.front();
}

}  // namespace

TEST_CASE("diff: a device has no differences to itself in any notation of numbers") {
  CHECK(lines(speed, speed).empty());
  CHECK(lines(speed, replaced(speed, "DefaultValue=5", "DefaultValue=0x05")).empty());
  CHECK(lines(speed, replaced(speed, "LowLimit=-10", "LowLimit=0xFFF6")).empty());
  CHECK(lines("[1800sub1]\nDefaultValue=$NODEID+0x180\nDataType=7\n[1800]\nObjectType=9\n",
              "[1800]\nObjectType=9\n\n[1800sub1]\nDataType=7\nDefaultValue=384+$nodeid\n")
            .empty());
}

TEST_CASE("diff: a removed object breaks networks, an added one does not") {
  CHECK(line(speed, "") == "breaking 2000h object: Speed -> ");
  CHECK(line("", speed) == "compatible 2000h object:  -> Speed");
}

TEST_CASE("diff: removed sub-objects break networks, added ones do not") {
  const std::string record = "[2100]\nParameterName=R\nObjectType=9\nSubNumber=1\n";
  const std::string sub = "[2100sub1F]\nParameterName=Last\nDataType=5\nAccessType=ro\n";
  CHECK(line(record + sub, record) == "breaking 2100h:1F sub-object: Last -> ");
  CHECK(line(record, record + sub) == "compatible 2100h:1F sub-object:  -> Last");
}

TEST_CASE("diff: reduced access breaks networks, extended access does not") {
  CHECK(line(speed, replaced(speed, "=rw", "=ro")) == "breaking 2000h access: rw -> ro");
  CHECK(line(speed, replaced(speed, "=rw", "=wo")) == "breaking 2000h access: rw -> wo");
  CHECK(line(replaced(speed, "=rw", "=ro"), speed) == "compatible 2000h access: ro -> rw");
  CHECK(line(replaced(speed, "=rw", "=const"), replaced(speed, "=rw", "=ro")) ==
        "compatible 2000h access: const -> ro");
  CHECK(line(replaced(speed, "=rw", "=wo"), replaced(speed, "=rw", "=ro")) == "breaking 2000h access: wo -> ro");
}

TEST_CASE("diff: a removed direction of mapping breaks networks") {
  CHECK(line(speed, replaced(speed, "PDOMapping=1", "PDOMapping=0")) == "breaking 2000h PDO mapping: 1 -> 0");
  CHECK(line(replaced(speed, "PDOMapping=1", "PDOMapping=0"), speed) == "compatible 2000h PDO mapping: 0 -> 1");
  CHECK(line(speed, replaced(speed, "=rw", "=rwr")) == "breaking 2000h access: rw -> rwr");
  CHECK(line(replaced(speed, "=rw", "=rww"), speed) == "compatible 2000h access: rww -> rw");
  CHECK(line(replaced(speed, "=rw", "=rww"), replaced(speed, "=rw", "=rwr")) == "breaking 2000h access: rww -> rwr");
}

TEST_CASE("diff: another type breaks networks") {
  CHECK(line(speed, replaced(speed, "0x0003", "0x0004")) == "breaking 2000h data type: 0x0003 -> 0x0004");
  CHECK(line("[2000]\nObjectType=7\nDataType=15\nAccessType=rw\n",
             "[2000]\nObjectType=2\nDataType=15\nAccessType=rw\n") == "breaking 2000h object type: 7 -> 2");
}

TEST_CASE("diff: narrower limits break networks; wider and removed ones do not") {
  CHECK(line(speed, replaced(speed, "=-10", "=-9")) == "breaking 2000h low limit: -10 -> -9");
  CHECK(line(speed, replaced(speed, "=-10", "=-11")) == "compatible 2000h low limit: -10 -> -11");
  CHECK(line(speed, replaced(speed, "HighLimit=10", "HighLimit=9")) == "breaking 2000h high limit: 10 -> 9");
  CHECK(line(speed, replaced(speed, "HighLimit=10", "HighLimit=0xB")) == "compatible 2000h high limit: 10 -> 0xB");
  CHECK(line(speed, replaced(speed, "HighLimit=10\n", "")) == "compatible 2000h high limit: 10 -> ");
  CHECK(line(replaced(speed, "HighLimit=10\n", ""), speed) == "breaking 2000h high limit:  -> 10");
}

TEST_CASE("diff: another default is compatible, except for PDOs, COB-IDs and the identity") {
  CHECK(line(speed, replaced(speed, "DefaultValue=5", "DefaultValue=6")) == "compatible 2000h default: 5 -> 6");
  CHECK(line(speed, replaced(speed, "DefaultValue=5\n", "")) == "compatible 2000h default: 5 -> ");
  const auto kind_of = [](const std::string& section) {
    const std::string object = "[" + section + "]\nObjectType=7\nDataType=7\nAccessType=rw\nDefaultValue=";
    return line(object + "1\n", object + "$NODEID+1\n").substr(0, 8);
  };
  for (const char* const index : {"1000", "1005", "1012", "1014", "1200", "12FF", "1400", "1600", "1800", "1BFF"}) {
    CHECK_MESSAGE(kind_of(index) == "breaking", index);
  }
  for (const char* const index : {"1006", "1015", "1017", "13FF", "1C00", "6000"}) {
    CHECK_MESSAGE(kind_of(index) == "compatib", index);
  }
}

TEST_CASE("diff: vendor-ID and product code break networks; revision and serial number do not") {
  const auto identity = [](const std::string& sub, const std::string& value) {
    return "[1018]\nObjectType=9\n[1018sub" + sub + "]\nDataType=7\nAccessType=ro\nDefaultValue=" + value + "\n";
  };
  for (const char* const sub : {"1", "2"}) {
    CHECK(line(identity(sub, "1"), identity(sub, "2")).substr(0, 8) == "breaking");
  }
  for (const char* const sub : {"3", "4"}) {
    CHECK(line(identity(sub, "1"), identity(sub, "2")).substr(0, 10) == "compatible");
  }
  CHECK(line("[DeviceInfo]\nVendorNumber=1\n", "[DeviceInfo]\nVendorNumber=2\n") == "breaking vendor number: 1 -> 2");
}

TEST_CASE("diff: removed services break networks, added ones do not") {
  const auto info = [](const std::string& line) { return "[DeviceInfo]\n" + line + "\n"; };
  CHECK(line(info("BaudRate_125=1"), info("BaudRate_125=0")) == "breaking 125 kbit/s: 1 -> 0");
  CHECK(line(info("BaudRate_125=0"), info("BaudRate_125=1")) == "compatible 125 kbit/s: 0 -> 1");
  CHECK(line(info("BaudRate_125=1"), info("")) == "breaking 125 kbit/s: 1 -> ");
  CHECK(line(info("NrOfRXPDO=4"), info("NrOfRXPDO=3")) == "breaking RPDOs: 4 -> 3");
  CHECK(line(info("NrOfTXPDO=4"), info("NrOfTXPDO=5")) == "compatible TPDOs: 4 -> 5");
  CHECK(line(info("LSS_Supported=1"), info("LSS_Supported=0")) == "breaking LSS slave: 1 -> 0");
  CHECK(line(info("Granularity=8"), info("Granularity=1")) == "compatible granularity: 8 -> 1");
  CHECK(line(info("Granularity=8"), info("Granularity=16")) == "breaking granularity: 8 -> 16");
  CHECK(line(info("Granularity=8"), info("Granularity=0")) == "breaking granularity: 8 -> 0");
  CHECK(line(info("Granularity=0"), info("Granularity=64")) == "compatible granularity: 0 -> 64");
  CHECK(line("[DummyUsage]\nDummy0005=1\n", "[DummyUsage]\nDummy0005=0\n") == "breaking dummy of type 5: 1 -> 0");
}

TEST_CASE("diff: names, file dates, and values and node-IDs of one device are separate kinds") {
  CHECK(line(speed, replaced(speed, "Speed", "Velocity")) == "text 2000h name: Speed -> Velocity");
  CHECK(line("[FileInfo]\nCreationDate=01-02-2003\n", "[FileInfo]\nCreationDate=01-02-2004\n") ==
        "file date of creation: 01-02-2003 -> 01-02-2004");
  CHECK(line(speed, speed + "ParameterValue=7\n") == "configuration 2000h value:  -> 7");
  CHECK(line("[DeviceComissioning]\nNodeID=1\n", "[DeviceComissioning]\nNodeID=2\n") ==
        "configuration node-ID: 1 -> 2");
}

TEST_CASE("diff: equal dates and times in the forms of EDS and XML are equal") {
  const auto file = [](const std::string& date, const std::string& time) {
    return "[FileInfo]\nCreationDate=" + date + "\nCreationTime=" + time + "\n";
  };
  CHECK(lines(file("12-31-2020", "09:30PM"), file("2020-12-31", "21:30:00")).empty());
  CHECK(line(file("12-31-2020", "09:30PM"), file("2020-12-30", "21:30:00")) ==
        "file date of creation: 12-31-2020 -> 2020-12-30");
  CHECK(line(file("12-31-2020", "09:30PM"), file("2020-12-31", "09:30:00")) ==
        "file time of creation: 09:30PM -> 09:30:00");
}

TEST_CASE("diff: properties are compared, those of CANopenNode and unknown ones") {
  const std::string original = test::bytes_of_fixture("device10.xdd");
  const auto changed = [&original](const std::string& name, const std::string& value, const std::string& other) {
    const std::string property = "<property name=\"" + name + "\" value=\"";
    const std::string known = property + value + "\"/>";
    const bool is_there = original.find(known) != std::string::npos;
    const std::string before = is_there ? original : replaced(original, "<property", known + "<property");
    const test::XmlReading a(before);
    const test::XmlReading b(replaced(before, known, property + other + "\"/>"));
    const std::vector<Difference> differences = compare(a.device, b.device);
    REQUIRE(differences.size() == 1);
    return std::string(name_of(differences.front().kind)) + " " + differences.front().what;
  };
  CHECK(changed("CO_disabled", "false", "true") == "compatible disabled");
  CHECK(changed("CO_countLabel", "MODE", "OTHER") == "compatible count label");
  CHECK(changed("CO_storageGroup", "PERSIST_COMM", "RAM") == "compatible storage group");
  CHECK(changed("CO_accessSRDO", "trx", "tx") == "compatible SRDO access");
  CHECK(changed("CO_stringLengthMin", "16", "8") == "breaking shortest capacity");
  CHECK(changed("CO_byteLength", "16", "20") == "compatible capacity");
  CHECK(changed("CO_flagsPDO", "true", "false") == "compatible TPDO on change");
  CHECK(changed("CO_extensionIO", "true", "false") == "compatible extension");
  CHECK(changed("Own", "kept", "changed") == "text property Own");
}

TEST_CASE("diff: storage group RAM equals none") {
  const std::string original = test::bytes_of_fixture("device10.xdd");
  const std::string group = "<property name=\"CO_storageGroup\" value=\"PERSIST_COMM\"/>";
  REQUIRE(original.find(group) != std::string::npos);
  const test::XmlReading ram(replaced(original, group, "<property name=\"CO_storageGroup\" value=\"RAM\"/>"));
  const test::XmlReading none(replaced(original, group, ""));
  CHECK(compare(ram.device, none.device).empty());
}

TEST_CASE("diff: the values of an enumeration are compared for each object of its type") {
  const std::string type =
      "<enum name=\"Mode\" uniqueID=\"T_Mode\"><enumValue value=\"1\"><label lang=\"en\">on</label></enumValue>"
      "<enumValue value=\"2\"/><USINT/></enum>";
  const auto told = [&type](const std::string& other) {
    const auto xdd = [](const std::string& definition) {
      return "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.1\" "
             "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"><ISO15745Profile><ProfileBody "
             "xsi:type=\"ProfileBody_Device_CANopen\"><ApplicationProcess><dataTypeList>" +
             definition +
             "</dataTypeList><parameterList><parameter uniqueID=\"P\" access=\"read\"><dataTypeIDRef "
             "uniqueIDRef=\"T_Mode\"/></parameter></parameterList></ApplicationProcess></ProfileBody>"
             "</ISO15745Profile><ISO15745Profile><ProfileBody xsi:type=\"ProfileBody_CommunicationNetwork_CANopen\">"
             "<ApplicationLayers><CANopenObjectList><CANopenObject index=\"2000\" name=\"Mode\" objectType=\"7\" "
             "uniqueIDRef=\"P\"/></CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile>"
             "</ISO15745ProfileContainer>";
    };
    const test::XmlReading a(xdd(type));
    const test::XmlReading b(xdd(other));
    std::string result;
    for (const Difference& one : compare(a.device, b.device)) {
      result += std::string(name_of(one.kind)) + " " + to_string(one.place) + " " + one.what + ": " + one.before +
                " -> " + one.after + "\n";
    }
    return result;
  };
  CHECK(told(replaced(type, "\"2\"", "\"0x2\"")).empty());
  CHECK(told(replaced(type, "\"2\"", "\"3\"")) ==
        "breaking 2000h allowed value: 2 -> \ncompatible 2000h allowed value:  -> 3\n");
  CHECK(told(replaced(type, ">on<", ">ready<")) == "text 2000h name of allowed value 1: on -> ready\n");
}

TEST_CASE("diff: an empty attribute or element of an XDD equals a missing one") {
  const std::string device = test::bytes_of(test::fixture("xdd/device10.xdd"));
  for (const std::string attribute : {" fileCreator=\"Ada\"", " subNumber=\"3\"", " denotation=\"", " PDOmapping=\"",
                                      " accessType=\"", " multiplier=\"", " nrOfTxPDO=\""}) {
    CAPTURE(attribute);
    const std::size_t name = device.find(attribute);
    REQUIRE(name != std::string::npos);
    const std::size_t value = device.find('"', name) + 1;
    const std::size_t end = device.find('"', value);
    const test::XmlReading empty(device.substr(0, value) + device.substr(end));
    const test::XmlReading missing(device.substr(0, name) + device.substr(end + 1));
    CHECK(compare(empty.device, missing.device).empty());
    CHECK(compare(missing.device, empty.device).empty());
  }
  for (const std::string element : {"<label lang=\"de\">", "<description lang=\"en\">"}) {
    CAPTURE(element);
    const std::size_t begin = device.find(element);
    REQUIRE(begin != std::string::npos);
    const std::size_t text = begin + element.size();
    const std::size_t end = device.find('<', text);
    const test::XmlReading empty(device.substr(0, text) + device.substr(end));
    const test::XmlReading missing(device.substr(0, begin) + device.substr(device.find('>', end) + 1));
    CHECK(compare(empty.device, missing.device).empty());
    CHECK(compare(missing.device, empty.device).empty());
  }
}

TEST_CASE("diff: DataType, AccessType and PDOMapping of an object with sub-objects break no networks") {
  const std::string record =
      "[2100]\nParameterName=R\nObjectType=9\nDataType=7\nAccessType=rw\nPDOMapping=1\n"
      "[2100sub1]\nParameterName=First\nDataType=5\nAccessType=rw\n";
  CHECK(line(record, replaced(record, "DataType=7\n", "")) == "compatible 2100h data type: 7 -> ");
  CHECK(line(record, replaced(record, "AccessType=rw", "AccessType=ro")) == "compatible 2100h access: rw -> ro");
  CHECK(line(record, replaced(record, "PDOMapping=1", "PDOMapping=0")) == "compatible 2100h PDO mapping: 1 -> 0");
  CHECK(line(record, replaced(record, "DataType=5", "DataType=6")) == "breaking 2100h:1 data type: 5 -> 6");
}

TEST_CASE("diff: objects of modules are compared by module") {
  const auto coupler = [](const std::string& access) {
    return "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=Input\n[M1FixedObjects]\nNrOfEntries=1\n"
           "1=0x6100\n[M1Fixed6100]\nParameterName=Bits\nObjectType=7\nDataType=5\nAccessType=" +
           access + "\n";
  };
  CHECK(line(coupler("rw"), coupler("ro")) == "breaking module 1, 6100h access: rw -> ro");
}

TEST_CASE("diff: a change that breaks networks needs a new major revision number [301: 7.5.2.18]") {
  const auto device = [](const std::string& revision, const std::string& access) {
    return device_of("[1018]\nObjectType=9\n[1018sub3]\nDataType=7\nAccessType=ro\nDefaultValue=" + revision +
                     "\n[2000]\nObjectType=7\nDataType=5\nAccessType=" + access + "\n");
  };
  const auto allowed = [](const Device& before, const Device& after) {
    return is_announced(before, after, compare(before, after));
  };
  CHECK(allowed(device("0x10000", "rw"), device("0x20000", "ro")));
  CHECK_FALSE(allowed(device("0x10000", "rw"), device("0x10001", "ro")));
  CHECK_FALSE(allowed(device("0x20000", "rw"), device("0x10000", "ro")));
  CHECK(allowed(device("0x10000", "ro"), device("0x10000", "rw")));
  CHECK_FALSE(allowed(device_of("[DeviceInfo]\nRevisionNumber=0x10000\n" + speed),
                      device_of("[DeviceInfo]\nRevisionNumber=0x1FFFF\n")));
  CHECK(allowed(device_of("[DeviceInfo]\nRevisionNumber=0x10000\n" + speed),
                device_of("[DeviceInfo]\nRevisionNumber=0x20000\n")));
}

TEST_CASE("diff: ranges and steps are compared: a removed value breaks networks") {
  const auto xdd = [](const std::string& ranges) {
    return test::xdd_with(
        "<CANopenObject index=\"2000\" name=\"x\" objectType=\"7\" dataType=\"05\" uniqueIDRef=\"p\"/>",
        "<parameter uniqueID=\"p\" access=\"readWrite\"><USINT/><allowedValues>" + ranges +
            "</allowedValues></parameter>");
  };
  const auto range = [](const std::string& low, const std::string& high, const std::string& step = "") {
    return "<range><minValue value=\"" + low + "\"/><maxValue value=\"" + high + "\"/>" +
           (step.empty() ? "" : "<step value=\"" + step + "\"/>") + "</range>";
  };
  const auto differences = [&](const std::string& before, const std::string& after) {
    const test::XmlReading a(xdd(before));
    const test::XmlReading b(xdd(after));
    std::string text;
    for (const Difference& one : compare(a.device, b.device)) {
      text += std::string(name_of(one.kind)) + " " + one.what + ": " + one.before + " -> " + one.after + "\n";
    }
    return text;
  };
  const std::string two = range("1", "5") + range("10", "20", "2");
  CHECK(differences(two, two) == "");
  CHECK(differences(two, range("10", "20", "2") + range("0x1", "5")) == "");  // in any order
  CHECK(differences(two, range("1", "5") + range("10", "20")) ==
        "breaking range: 10..20 step 2 -> \ncompatible range:  -> 10..20\n");
  CHECK(differences(two, "") == "compatible range: 1..5 -> \ncompatible range: 10..20 step 2 -> \n");
  CHECK(differences(range("1", "5"), range("1", "5", "2")) == "breaking step:  -> 2\n");
  CHECK(differences(range("1", "5", "2"), range("1", "5")) == "compatible step: 2 -> \n");
}

TEST_CASE("diff: equal file versions in another notation are equal") {
  const test::XmlReading xml(
      "<ISO15745ProfileContainer xmlns=\"http://www.canopen.org/xml/1.0\"><ISO15745Profile>"
      "<ProfileBody fileVersion=\"1.0\"><DeviceIdentity/></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>");
  Findings findings;
  const lexican::codict::eds::Document document(Source("a.eds", "[FileInfo]\nFileVersion=1.0\n"), findings);
  CHECK(compare(lexican::codict::eds::read(document, findings).devices.front(), xml.device).empty());
  Device other = xml.device;
  other.file.version.text = "1.1";
  other.file.version.value = 0;
  CHECK(compare(xml.device, other).size() == 1);
}
