// SPDX-License-Identifier: Apache-2.0
// Cases OD 01 to OD 09 of CiA's conformance test with generated dictionaries: "The description matches the device".
// Each case also runs with descriptions that are wrong in one place, which it has to report.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "clock/dictionary.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "every_c_od.h"
#include "every_cpp_od.h"
#include "od_conformance.hpp"

namespace {

std::uint8_t pixels[] = {1, 2, 3, 4, 5, 6};
const std::uint8_t hardware[] = "test";

}  // namespace

CO_OBJ_STR clock_1009_0 = {0, hardware};
CO_OBJ_DOM clock_2200_0 = {0, sizeof pixels, pixels};

namespace {

using lexican::codict::Description;
using lexican::codict::Device;
using lexican::codict::Findings;
using lexican::codict::Source;
using test::beyond;
using test::communication;
using test::Contradictions;
using test::GeneratedNode;
using test::Memory;
using test::OdConformance;

struct Described {
  const char* eds;
  const CO_OBJ* od;
  std::uint16_t length;
};

const Described demo_clock = {LEXICAN_SOURCE_DIR "/demo/clock/generated/clock.eds", clock_od, CLOCK_OD_NUM};
const Described every_c = {LEXICAN_CODICT_FIXTURES "/gen/every_kind.eds", every_c_od, EVERY_C_OD_NUM};
const Described every_cpp = {LEXICAN_CODICT_FIXTURES "/gen/every_kind.eds", every_cpp_od, EVERY_CPP_OD_NUM};

std::string text_of(const Described& described) {
  std::ifstream file(described.eds, std::ios::binary);
  REQUIRE(file);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
  return text;
}

using Check = Contradictions (OdConformance::*)();

Contradictions check(const Described& described, std::string eds, Check one, test::Area area) {
  Findings findings;
  const lexican::codict::eds::Document document(Source("device.eds", std::move(eds)), findings);
  const Description description = lexican::codict::eds::read(document, findings);
  clock_set_defaults();
  every_c_set_defaults();
  every_cpp_set_defaults();
  Memory memory;
  const lexican::Errors errors = lexican::demo::clock_errors();
  GeneratedNode node(described.od, described.length, memory, {errors.first, errors.number});
  REQUIRE(node.fault == CO_DICT_OK);
  return (OdConformance(description.devices.front(), node, area).*one)();
}

/// Checks that the devices match their descriptions.
void check_all(Check one, test::Area area) {
  for (const Described* const described : {&demo_clock, &every_c, &every_cpp}) {
    CAPTURE(described->eds);
    CHECK(check(*described, text_of(*described), one, area) == Contradictions{});
  }
}

std::pair<std::size_t, std::size_t> section_of(const std::string& eds, const std::string& name) {
  const std::size_t begin = eds.find("[" + name + "]\n");
  REQUIRE(begin != std::string::npos);
  return {begin, std::min(eds.find("\n[", begin), eds.size() - 1) + 1};
}

/// Replaces a line of a section.
std::string changed(std::string eds, const std::string& section, const std::string& line, const std::string& other) {
  const auto [begin, end] = section_of(eds, section);
  const std::size_t place = eds.find("\n" + line + "\n", begin);
  REQUIRE(place < end);
  return eds.replace(place + 1, line.size(), other);
}

std::string without(std::string eds, const std::string& section) {
  const auto [begin, end] = section_of(eds, section);
  return eds.erase(begin, end - begin);
}

std::string with(const std::string& eds, const std::string& section, const std::string& type) {
  return eds + "\n[" + section + "]\nParameterName=More\nObjectType=0x7\nDataType=" + type +
         "\nAccessType=rw\nPDOMapping=0\n";
}

}  // namespace

TEST_CASE("[OD 01] communication objects are read and written with their access type and length") {
  check_all(&OdConformance::access, communication);
}

TEST_CASE("[OD 01] a communication object that is missing or has another type or access is detected") {
  const auto found = [](const std::string& eds) {
    return check(demo_clock, eds, &OdConformance::access, communication);
  };
  const std::string eds = text_of(demo_clock);
  CHECK(found(with(eds, "1016", "0x0007")) ==
        Contradictions{"1016h:00 read: abort 06020000, not a value", "1016h:00 write: abort 06020000, not ok"});
  CHECK(found(with(eds, "1018sub5", "0x0007")) ==
        Contradictions{"1018h:05 read: abort 06090011, not a value", "1018h:05 write: abort 06090011, not ok"});
  CHECK(found(changed(eds, "1017", "DataType=0x0006", "DataType=0x0007")) ==
        Contradictions{"1017h:00 length: E8 03, not 4 bytes"});
  CHECK(found(changed(eds, "1018sub2", "AccessType=ro", "AccessType=rw")) ==
        Contradictions{"1018h:02 write: abort 06010002, not ok"});
}

TEST_CASE("[OD 02] communication objects have the default values of the EDS with the node-ID added") {
  check_all(&OdConformance::defaults, communication);
}

TEST_CASE("[OD 02] another default value, constant or sub-index 0 of a communication object is detected") {
  const auto found = [](const std::string& section, const std::string& line, const std::string& other) {
    const std::string eds = changed(text_of(demo_clock), section, line, other);
    return check(demo_clock, eds, &OdConformance::defaults, communication);
  };
  CHECK(found("1017", "DefaultValue=1000", "DefaultValue=1001") ==
        Contradictions{"1017h:00 default: E8 03, not E9 03"});
  CHECK(found("1014", "DefaultValue=$NODEID+0x80", "DefaultValue=0x80") ==
        Contradictions{"1014h:00 default: 85 00 00 00, not 80 00 00 00"});
  CHECK(found("1018sub0", "DefaultValue=4", "DefaultValue=3") == Contradictions{"1018h:00 default: 04, not 03"});
  CHECK(found("1008", "DefaultValue=Lexican demo clock", "DefaultValue=Le").size() == 1);
}

TEST_CASE("[OD 03] a write to a read-only or constant communication object is refused with 0601 0002h") {
  check_all(&OdConformance::read_only, communication);
}

TEST_CASE("[OD 03] a writable communication object that is described as read-only is detected") {
  const std::string eds = changed(text_of(demo_clock), "1006", "AccessType=rw", "AccessType=ro");
  CHECK(check(demo_clock, eds, &OdConformance::read_only, communication) ==
        Contradictions{"1006h:00 write: ok, not abort 06010002"});
}

TEST_CASE("[OD 04] no communication object is write-only; one described as write-only is detected") {
  check_all(&OdConformance::write_only, communication);
  const std::string eds = changed(text_of(demo_clock), "1006", "AccessType=rw", "AccessType=wo");
  CHECK(check(demo_clock, eds, &OdConformance::write_only, communication) ==
        Contradictions{"1006h:00 read: 00 00 00 00, not abort 06010001"});
}

TEST_CASE("[OD 05] sub-index FFh is missing or contains type and object code; sub-index 0 is the highest sub-index") {
  check_all(&OdConformance::structure, communication);
  check_all(&OdConformance::structure, beyond);
}

TEST_CASE("[OD 05] a structure that differs from the EDS is detected") {
  constexpr CO_OBJ od[] = {
      {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
      {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
      {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
      {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
      {CO_KEY(0x2200, 0x00, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
      {CO_KEY(0x2200, 0x01, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(0)},
      {CO_KEY(0x2200, 0x02, CO_OBJ_D___R_), CO_TUNSIGNED16, (CO_DATA)(0)},
      {CO_KEY(0x2200, 0xFF, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x0608)},
  };
  const Described device = {"", od, sizeof od / sizeof od[0]};
  const auto found = [&device](const std::string& type, const std::string& code, const std::string& last) {
    const auto sub = [](const std::string& number, const std::string& of) {
      return "[2200sub" + number + "]\nParameterName=Sub\nDataType=" + of + "\nAccessType=ro\n";
    };
    const std::string eds =
        "[2200]\nParameterName=Array\nObjectType=" + code + "\n" + sub("0", "5") + sub("1", type) + sub(last, type);
    return check(device, eds, &OdConformance::structure, beyond);
  };
  CHECK(found("6", "8", "2") == Contradictions{});
  CHECK(found("7", "8", "2") == Contradictions{"2200h:FF structure: 08 06 00 00, not 08 07 00 00"});
  CHECK(found("6", "9", "2") == Contradictions{"2200h:FF structure: 08 06 00 00, not 09 06 00 00"});
  CHECK(found("6", "8", "3") == Contradictions{"2200h:00 highest sub-index: 02, not 03"});
}

TEST_CASE("[OD 06] communication objects accept values within their limits, others are 0609 0031h and 0032h") {
  check_all(&OdConformance::limits, communication);
}

TEST_CASE("[OD 06] a limit of a communication object that differs from the EDS is detected") {
  const auto found = [](const std::string& line) {
    const std::string eds = changed(text_of(every_c), "1017", "HighLimit=10000", line);
    return check(every_c, eds, &OdConformance::limits, communication);
  };
  CHECK(found("HighLimit=9999") == Contradictions{"1017h:00 10 27: ok, not abort 06090031"});
  CHECK(found("HighLimit=10001") == Contradictions{
                                        "1017h:00 11 27: abort 06090031, not ok",
                                    });
}

TEST_CASE("[OD 07] all other objects are read and written with their access type and length") {
  check_all(&OdConformance::access, beyond);
}

TEST_CASE("[OD 07] another object that is missing or has another type or access is detected") {
  const auto found = [](const std::string& eds) { return check(demo_clock, eds, &OdConformance::access, beyond); };
  const std::string eds = text_of(demo_clock);
  CHECK(found(with(eds, "6000", "0x0005")) ==
        Contradictions{"6000h:00 read: abort 06020000, not a value", "6000h:00 write: abort 06020000, not ok"});
  CHECK(found(changed(eds, "2101", "DataType=0x0003", "DataType=0x0004")) ==
        Contradictions{"2101h:00 length: 00 00, not 4 bytes"});
  CHECK(found(changed(eds, "2100sub0", "AccessType=const", "AccessType=rw")) ==
        Contradictions{"2100h:00 write: abort 06010002, not ok"});
}

TEST_CASE("[OD 08] all other objects have the default values of the EDS") {
  check_all(&OdConformance::defaults, beyond);
}

TEST_CASE("[OD 08] another default value of another object is detected") {
  const auto found = [](const Described& described, const char* section, const char* line, const char* other) {
    const std::string eds = changed(text_of(described), section, line, other);
    return check(described, eds, &OdConformance::defaults, beyond);
  };
  CHECK(found(demo_clock, "2101", "DefaultValue=0", "DefaultValue=-60") ==
        Contradictions{"2101h:00 default: 00 00, not C4 FF"});
  CHECK(found(every_c, "2008", "DefaultValue=1.5", "DefaultValue=1.25") ==
        Contradictions{"2008h:00 default: 00 00 C0 3F, not 00 00 A0 3F"});
  CHECK(found(every_cpp, "2009", "DefaultValue=text", "DefaultValue=test") ==
        Contradictions{"2009h:00 default: 74 65 78 74, not 74 65 73 74"});
}

TEST_CASE("[OD 09] all other objects refuse accesses beyond their access right and limits") {
  check_all(&OdConformance::read_only, beyond);
  check_all(&OdConformance::write_only, beyond);
  check_all(&OdConformance::limits, beyond);
}

TEST_CASE("[OD 09] another access right or limit of another object is detected") {
  const auto found = [](const Described& described, Check one, const char* section, const char* line,
                        const char* other) {
    return check(described, changed(text_of(described), section, line, other), one, beyond);
  };
  CHECK(found(demo_clock, &OdConformance::read_only, "2101", "AccessType=rw", "AccessType=ro") ==
        Contradictions{"2101h:00 write: ok, not abort 06010002"});
  CHECK(found(every_c, &OdConformance::write_only, "2020", "AccessType=ro", "AccessType=wo") ==
        Contradictions{"2020h:00 read: 07 00, not abort 06010001"});
  CHECK(found(demo_clock, &OdConformance::limits, "2100sub1", "HighLimit=23", "HighLimit=22") ==
        Contradictions{"2100h:01 17: ok, not abort 06090031"});
  CHECK(found(demo_clock, &OdConformance::limits, "2101", "LowLimit=-720", "LowLimit=-721") ==
        Contradictions{"2101h:00 2F FD: abort 06090032, not ok"});
  CHECK(found(demo_clock, &OdConformance::limits, "2101", "LowLimit=-720", "LowLimit=-719") ==
        Contradictions{"2101h:00 30 FD: ok, not abort 06090032"});
}

TEST_CASE("[SDO 05, 06] objects missing in the EDS are refused with 0602 0000h and 0609 0011h") {
  check_all(&OdConformance::absence, communication);
  check_all(&OdConformance::absence, {0, 0x0FFF});
  CHECK(check(demo_clock, text_of(demo_clock), &OdConformance::absence, beyond) == Contradictions{});
}

TEST_CASE("[SDO 05, 06] an object or a sub-object that the EDS does not describe is detected") {
  const auto found = [](const std::string& section, test::Area area) {
    return check(demo_clock, without(text_of(demo_clock), section), &OdConformance::absence, area);
  };
  CHECK(found("1006", communication) == Contradictions{"1006h:00 not described: 00 00 00 00, not abort 06020000"});
  CHECK(found("2101", {0x2101, 0x2101}) == Contradictions{"2101h:00 not described: 00 00, not abort 06020000"});
  CHECK(found("1018sub4", communication) == Contradictions{"1018h:04 not described: 01 00 00 00, not abort 06090011"});
}

TEST_CASE("[PDO 27-32] PDOs accept only mappable objects in the direction of their access") {
  check_all(&OdConformance::mapping, beyond);
  check_all(&OdConformance::flags, communication);
  check_all(&OdConformance::flags, beyond);
}

TEST_CASE("[PDO 27-32] an object whose mappability differs from the EDS is detected") {
  const std::string eds = changed(text_of(demo_clock), "2101", "PDOMapping=0", "PDOMapping=1");
  CHECK(check(demo_clock, eds, &OdConformance::flags, beyond) == Contradictions{"2101h:00 mappable: no, not yes"});
  const std::string every = changed(text_of(every_c), "2003", "PDOMapping=1", "PDOMapping=0");
  CHECK(check(every_c, every, &OdConformance::flags, beyond) == Contradictions{"2003h:00 mappable: yes, not no"});
  CHECK(check(every_c, every, &OdConformance::mapping, beyond) ==
        Contradictions{"2003h:00 mapped to an RPDO: ok, not abort 06040041",
                       "2003h:00 mapped to a TPDO: ok, not abort 06040041"});
}

TEST_CASE("[EDS] DeviceInfo is the identity of 1018h; another one is detected") {
  check_all(&OdConformance::identity, communication);
  const std::string eds = changed(text_of(demo_clock), "DeviceInfo", "ProductNumber=0x0000C10C", "ProductNumber=1");
  CHECK(check(demo_clock, eds, &OdConformance::identity, communication) ==
        Contradictions{"1018h:02 identity: 0C C1 00 00, not 01 00 00 00"});
}
