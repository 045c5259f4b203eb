// SPDX-License-Identifier: Apache-2.0
// Checks of PDOs, COB-IDs, services, and relations between objects, independent of the format.
#include "check/network.hpp"

#include <doctest/doctest.h>

#include <string>

#include "check/check.hpp"
#include "check/profile.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"

using namespace lexican::codict;

namespace {

Device device_of(const std::string& eds) {
  Findings findings;
  const eds::Document document(Source("device.eds", eds), findings);
  return eds::read(document, findings).devices.front();
}

// Returns "rule: text" of each finding, one per line.
std::string found(void (*check)(const Device&, Findings&), const std::string& eds) {
  Findings findings;
  check(device_of(eds), findings);
  std::string text;
  for (const Finding& finding : findings.all()) {
    text += std::string(finding.rule->id) + ": " + finding.text + "\n";
  }
  return text;
}

std::string variable(const std::string& index, const std::string& type, const std::string& access,
                     const std::string& value = "", const std::string& mapping = "1") {
  return "[" + index + "]\nParameterName=x\nObjectType=7\nDataType=" + type + "\nAccessType=" + access +
         "\nDefaultValue=" + value + "\nPDOMapping=" + mapping + "\n";
}

std::string record(const std::string& index, std::initializer_list<std::string> values) {
  std::string text = "[" + index + "]\nParameterName=x\nObjectType=9\n";
  unsigned sub_index = 0;
  for (const std::string& value : values) {
    if (!value.empty()) {
      text += "[" + index + "sub" + std::to_string(sub_index) +
              "]\nParameterName=x\nDataType=7\nAccessType=rw\nDefaultValue=" + value + "\n";
    }
    ++sub_index;
  }
  return text;
}

const std::string tpdo_communication = record("1800", {"5", "$NODEID+0x180", "255", "0", "", "0"});
const std::string rpdo_communication = record("1400", {"2", "$NODEID+0x200", "255"});
const std::string number = variable("2000", "6", "rw");

std::string of_tpdo(std::initializer_list<std::string> mapping, const std::string& objects = number) {
  return found(check::check_pdo_parameters, tpdo_communication + record("1A00", mapping) + objects);
}

std::string of_rpdo(std::initializer_list<std::string> mapping, const std::string& objects = number) {
  return found(check::check_pdo_parameters, rpdo_communication + record("1600", mapping) + objects);
}

}  // namespace

TEST_CASE("check: a PDO that maps mappable objects has no findings") {
  CHECK(of_tpdo({"1", "0x20000010"}) == "");
  CHECK(of_rpdo({"1", "0x20000010"}) == "");
  CHECK(of_tpdo({"4", "0x20000010", "0x20000010", "0x20000010", "0x20000010"}) == "");
}

TEST_CASE("check: pdo-empty: a PDO with a valid COB-ID must map an object") {
  const auto with = [](const char* cob_id, std::initializer_list<std::string> mapping) {
    return found(check::check_pdo_parameters, record("1800", {"2", cob_id, "255"}) + record("1A00", mapping) + number);
  };
  const std::string empty = "pdo-empty: TPDO 1 has a valid COB-ID, but maps no object\n";
  CHECK(with("$NODEID+0x180", {"0"}) == empty);
  CHECK(with("$NODEID+0x180", {"0", "0x20000010"}) == empty);
  CHECK(with("0x80000180", {"0"}) == "");
  CHECK(with("$NODEID+0xC0000180", {"0"}) == "");
  CHECK(with("0x180", {"0xFE"}) == "");  // a multiplex PDO
  CHECK(with("text", {"0"}) == "");
  CHECK(of_rpdo({"0"}) == "pdo-empty: RPDO 1 has a valid COB-ID, but maps no object\n");
}

TEST_CASE("check: pdo-pair: communication and mapping parameters both exist, except for compact PDOs") {
  CHECK(found(check::check_pdo_parameters, tpdo_communication) == "pdo-pair: TPDO 1 has no mapping parameter\n");
  CHECK(found(check::check_pdo_parameters, record("1601", {"0"})) ==
        "pdo-pair: RPDO 2 has no communication parameter\n");
  // CompactPDO implies the mapping parameter, with nothing mapped.
  CHECK(found(check::check_pdo_parameters, "[DeviceInfo]\nCompactPDO=0x3\n" + tpdo_communication) ==
        "pdo-empty: TPDO 1 has a valid COB-ID, but maps no object\n");
}

TEST_CASE("check: pdo-object: a mapped object must be described") {
  CHECK(of_tpdo({"1", "0x20010010"}) == "pdo-object: mapped object 2001h does not exist\n");
  CHECK(of_tpdo({"1", "0x20000110"}) == "pdo-object: mapped object 2000h:01 does not exist\n");
}

namespace {

// Returns the finding for a PDO that maps 2000h with this access and PDO mapping.
std::string refused(const char* pdo, const std::string& access, const char* mapping, const char* object = "2000h 'x'") {
  return std::string("pdo-access: ") + pdo + " maps " + object + " (access " + access + ", PDO mapping " + mapping +
         ")\n";
}

}  // namespace

TEST_CASE("check: pdo-access: a mapped object must be mappable in the direction of the PDO") {
  const auto tpdo = [](const char* access) { return of_tpdo({"1", "0x20000010"}, variable("2000", "6", access)); };
  const auto rpdo = [](const char* access) { return of_rpdo({"1", "0x20000010"}, variable("2000", "6", access)); };
  for (const char* const access : {"ro", "rwr", "const"}) {
    CHECK(tpdo(access) == "");
    CHECK(rpdo(access) == refused("RPDO 1", access, "optional"));
  }
  for (const char* const access : {"wo", "rww"}) {
    CHECK(tpdo(access) == refused("TPDO 1", access, "optional"));
    CHECK(rpdo(access) == "");
  }
  CHECK(of_tpdo({"1", "0x20000010"}, variable("2000", "6", "rw", "", "0")) == refused("TPDO 1", "rw", "no"));
}

TEST_CASE("check: pdo-access: PDOMapping=0 is reported for each mapping that contains the object") {
  const std::string no_tpdo = refused("TPDO 1", "rw", "no");
  const std::string no_rpdo = refused("RPDO 1", "rw", "no");
  const std::string unsaid = "[2000]\nParameterName=x\nObjectType=7\nDataType=6\nAccessType=rw\nDefaultValue=0\n";
  const std::string of_array =
      "[2000]\nParameterName=x\nObjectType=8\nSubNumber=2\n"
      "[2000sub0]\nParameterName=x\nDataType=5\nAccessType=ro\nDefaultValue=1\n"
      "[2000sub1]\nParameterName=x\nDataType=6\nAccessType=rw\nPDOMapping=0\n";
  const std::string compact =
      "[2000]\nParameterName=x\nObjectType=8\nDataType=6\nAccessType=rw\nPDOMapping=0\n"
      "CompactSubObj=2\n";
  CHECK(of_rpdo({"1", "0x20000010"}, variable("2000", "6", "rw", "", "0")) == no_rpdo);
  CHECK(of_tpdo({"1", "0x20000010"}, unsaid) == no_tpdo);
  CHECK(of_rpdo({"1", "0x20000010"}, unsaid) == no_rpdo);
  CHECK(of_tpdo({"1", "0x20000110"}, of_array) == refused("TPDO 1", "rw", "no", "2000h:01 'x'"));
  CHECK(of_tpdo({"1", "0x20000210"}, compact) == refused("TPDO 1", "rw", "no", "2000h:02 'x2'"));
  CHECK(of_tpdo({"2", "0x20010010", "0x20000010"}, unsaid + variable("2001", "6", "ro")) == no_tpdo);
  // The mapping of a disabled PDO is checked, too.
  CHECK(found(check::check_pdo_parameters,
              record("1800", {"2", "0x80000180", "255"}) + record("1A00", {"1", "0x20000010"}) + unsaid) == no_tpdo);
  // Mapping entries above the number of mapped objects are ignored.
  CHECK(of_tpdo({"0", "0x20000010"}, unsaid) == "pdo-empty: TPDO 1 has a valid COB-ID, but maps no object\n");
}

TEST_CASE("check: pdo-bits, pdo-part: an object must be mapped completely; a BOOLEAN may be a byte") {
  CHECK(of_tpdo({"1", "0x20000020"}) == "pdo-bits: mapping of 32 bits, but 2000h 'x' has 16\n");
  CHECK(of_tpdo({"1", "0x20000008"}) == "pdo-part: mapping of 8 bits, but 2000h 'x' has 16\n");
  CHECK(of_tpdo({"1", "0x20000001"}, variable("2000", "1", "ro")) == "");
  CHECK(of_tpdo({"1", "0x20000008"}, variable("2000", "1", "ro")) == "");
  CHECK(of_tpdo({"1", "0x20000009"}, variable("2000", "1", "ro")) ==
        "pdo-bits: mapping of 9 bits, but 2000h 'x' has 1\n");
  CHECK(of_tpdo({"1", "0x20000040"}, variable("2000", "0x0A", "ro")) == "");
}

TEST_CASE("check: pdo-length: a mapping has at most 64 bits") {
  const std::string wide = variable("2000", "7", "rw");
  CHECK(of_tpdo({"2", "0x20000020", "0x20000020"}, wide) == "");
  CHECK(of_tpdo({"3", "0x20000020", "0x20000020", "0x20000020"}, wide) ==
        "pdo-length: TPDO 1 has 96 bits, more than 64\n");
}

TEST_CASE("check: pdo-gap, pdo-mapped-count: sub-index 0 must count the mapped objects") {
  CHECK(of_tpdo({"2", "0x20000010"}) == "pdo-gap: sub-index 0 is 2, but the number of mapped objects is 1\n");
  CHECK(of_tpdo({"2", "0x20000010", "0"}) == "pdo-gap: sub-index 0 is 2, but the number of mapped objects is 1\n");
  CHECK(of_tpdo({"1", "0x20000010", "0"}) == "");
  CHECK(of_tpdo({"65"}) == "pdo-mapped-count: 65 is not a number of mapped objects\n");
  CHECK(of_tpdo({"0xFE"}) == "");
  CHECK(of_tpdo({"0xFF"}) == "");
}

TEST_CASE("check: pdo-dummy: dummies are allowed in RPDOs with types that the device lists") {
  CHECK(of_tpdo({"1", "0x00050008"}) == "pdo-dummy: dummy mapping in a TPDO\n");
  CHECK(of_rpdo({"1", "0x00050008"}) == "pdo-dummy: dummy mapping of UNSIGNED8, which the device does not support\n");
  CHECK(of_rpdo({"1", "0x00050008"}, "[DummyUsage]\nDummy0005=1\n") == "");
  CHECK(of_rpdo({"1", "0x00050008"}, "[DummyUsage]\nDummy0005=0\nDummy0006=1\n") ==
        "pdo-dummy: dummy mapping of UNSIGNED8, which the device does not support\n");
}

TEST_CASE("check: pdo-granularity: mapped lengths must be multiples of it") {
  const std::string bit = variable("2000", "1", "ro");
  CHECK(of_tpdo({"1", "0x20000001"}, bit + "[DeviceInfo]\nGranularity=8\n") ==
        "pdo-granularity: mapped length 1 is not a multiple of the granularity 8\n");
  CHECK(of_tpdo({"1", "0x20000001"}, bit + "[DeviceInfo]\nGranularity=1\n") == "");
}

TEST_CASE("check: pdo-type: types must be defined by CiA 301, remote ones for TPDOs only") {
  const auto type = [](const char* index, const char* mapping, const char* value) {
    return found(check::check_pdo_parameters, record(index, {"2", "0x80000000", value}) + record(mapping, {"0"}));
  };
  const auto wrong = [](const char* pdo, const char* value) {
    return std::string("pdo-type: ") + pdo + " has invalid transmission type " + value + "\n";
  };
  for (const char* const value : {"0", "1", "240", "254", "255"}) {
    CHECK(type("1400", "1600", value) == "");
    CHECK(type("1800", "1A00", value) == "");
  }
  for (const char* const value : {"241", "251", "256"}) {
    CHECK(type("1400", "1600", value) == wrong("RPDO 1", value));
    CHECK(type("1800", "1A00", value) == wrong("TPDO 1", value));
  }
  for (const char* const value : {"252", "253"}) {
    CHECK(type("1400", "1600", value) == wrong("RPDO 1", value));
    CHECK(type("1800", "1A00", value) == "");
  }
}

TEST_CASE("check: pdo-time: inhibit and event time need event-driven PDOs") {
  const auto times = [](const char* type, const char* inhibit, const char* event) {
    return found(check::check_pdo_parameters,
                 record("1800", {"5", "0x80000000", type, inhibit, "", event}) + record("1A00", {"0"}));
  };
  CHECK(times("1", "10", "0") == "pdo-time: inhibit time 10 has no effect without events\n");
  CHECK(times("253", "0", "10") == "pdo-time: event time 10 has no effect without events\n");
  CHECK(times("1", "0", "0") == "");
  CHECK(times("254", "10", "10") == "");
}

TEST_CASE("check: pdo-sync-missing: a synchronous PDO needs 1005h") {
  const auto with = [](const char* communication, const char* mapping, const char* cob_id, const char* type,
                       const std::string& others = "") {
    return found(check::check_pdo_parameters,
                 record(communication, {"2", cob_id, type}) + record(mapping, {"1", "0x20000010"}) + number + others);
  };
  const std::string rpdo = "pdo-sync-missing: RPDO 1 depends on SYNC, but object 1005h is missing\n";
  const std::string tpdo = "pdo-sync-missing: TPDO 1 depends on SYNC, but object 1005h is missing\n";
  for (const char* const type : {"0", "1", "240"}) {
    CHECK(with("1400", "1600", "0x201", type) == rpdo);
    CHECK(with("1800", "1A00", "$NODEID+0x40000180", type) == tpdo);
  }
  CHECK(with("1800", "1A00", "0x181", "252") == tpdo);
  CHECK(with("1800", "1A00", "0x181", "253") == "");
  CHECK(with("1800", "1A00", "0x181", "255") == "");
  CHECK(with("1800", "1A00", "0x80000181", "1") == "");
  CHECK(with("1800", "1A00", "0x181", "1", variable("1005", "7", "rw", "0x80")) == "");
  CHECK(with("1800", "1A00", "0x181", "1", record("1801", {"2", "0x281", "1"}) + record("1A01", {"1", "0x20000010"})) ==
        tpdo);
}

TEST_CASE("check: values of a DCF are checked instead of defaults") {
  std::string mapping = record("1A00", {"1", "0x20000010"});
  mapping += "ParameterValue=0x20000020\n";
  CHECK(found(check::check_pdo_parameters, tpdo_communication + mapping + number) ==
        "pdo-bits: mapping of 32 bits, but 2000h 'x' has 16\n");
}

TEST_CASE("check: cob-id-restricted: a CAN-ID reserved by CiA 301 is reported [301: table 40]") {
  const auto emcy = [](const std::string& value) {
    return found(check::check_cob_ids, variable("1014", "7", "rw", value));
  };
  const std::string wrong = "cob-id-restricted: COB-ID ";
  for (const char* const value : {"0", "0x001", "0x07F", "0x101", "0x180", "0x581", "0x5FF", "0x601", "0x67F", "0x6E0",
                                  "0x6FF", "0x701", "0x7FF"}) {
    CHECK_MESSAGE(emcy(value).substr(0, wrong.size()) == wrong, value);
  }
  for (const char* const value : {"0x080", "0x100", "0x181", "0x580", "0x600", "0x680", "0x6DF", "0x700"}) {
    CHECK_MESSAGE(emcy(value) == "", value);
  }
  CHECK(emcy("0x80000000") == "");
  CHECK(emcy("0x20000001") == "");
}

TEST_CASE("check: cob-id-form: a CAN-ID above 7FFh needs bit 29") {
  CHECK(found(check::check_cob_ids, variable("1014", "7", "rw", "0x881")) ==
        "cob-id-form: COB-ID 881h has more than 11 bits, but bit 29 is 0\n");
  CHECK(found(check::check_cob_ids, variable("1014", "7", "rw", "0x20000881")) == "");
}

TEST_CASE("check: cob-id-twice: a CAN-ID must have one service, with and without a node-ID") {
  const std::string sync = variable("1005", "7", "rw", "0x80");
  CHECK(found(check::check_cob_ids, sync + variable("1014", "7", "rw", "$NODEID+0x80")) == "");
  CHECK(found(check::check_cob_ids, sync + variable("1014", "7", "rw", "0x80")) ==
        "cob-id-twice: COB-ID 080h is also that of SYNC\n");
  CHECK(found(check::check_cob_ids, sync + variable("1014", "7", "rw", "0x20000080")) == "");
  CHECK(found(check::check_cob_ids, sync + variable("1014", "7", "rw", "0x80000080")) == "");
  CHECK(
      found(check::check_cob_ids, record("1201", {"2", "0x640", "0x5C0"}) + record("1280", {"2", "0x640", "0x5C0"})) ==
      "cob-id-restricted: COB-ID 640h is restricted by CiA 301 (default SDO)\n"
      "cob-id-restricted: COB-ID 5C0h is restricted by CiA 301 (default SDO)\n");
}

TEST_CASE("check: od-mandatory, od-error-control: missing mandatory objects are reported") {
  const std::string all = variable("1000", "7", "ro", "0") + variable("1001", "5", "ro", "0") +
                          record("1018", {"1", "1"}) + variable("1017", "6", "rw", "0");
  CHECK(found(check::check_services, all) == "");
  CHECK(found(check::check_services, "") ==
        "od-mandatory: mandatory object 1000h 'Device type' is missing\nod-mandatory: mandatory object 1001h 'Error "
        "register' is missing\n"
        "od-mandatory: mandatory object 1018h 'Identity object' is missing\n"
        "od-error-control: neither heartbeat nor node guarding\n");
}

namespace {

const std::string basis = variable("1000", "7", "ro", "0") + variable("1001", "5", "ro", "0") +
                          record("1018", {"1", "1"}) + variable("100C", "6", "rw", "0") +
                          variable("100D", "5", "rw", "0");

std::string of_services(const std::string& objects) { return found(check::check_services, basis + objects); }

}  // namespace

TEST_CASE("check: sdo-default: the COB-IDs of the first server are fixed [301: 7.5.2.33]") {
  CHECK(of_services(record("1200", {"2", "$NODEID+0x600", "$NODEID+0x580"})) == "");
  CHECK(of_services(record("1200", {"2", "0x600", "0x580"})) == "");
  CHECK(of_services(record("1200", {"2", "$NODEID+0x580", "$NODEID+0x600"})) ==
        "sdo-default: COB-ID $NODEID+0x580 is not 600h plus the node-ID\n"
        "sdo-default: COB-ID $NODEID+0x600 is not 580h plus the node-ID\n");
  CHECK(of_services("[DeviceComissioning]\nNodeID=5\n" + record("1200", {"2", "0x605", "0x585"})) == "");
  CHECK(of_services("[DeviceComissioning]\nNodeID=6\n" + record("1200", {"1", "0x605"})) ==
        "sdo-default: COB-ID 0x605 is not 600h plus the node-ID\n");
}

TEST_CASE("check: heartbeat-consumer: node-ID and time must be valid, each node once [301: 7.5.2.19]") {
  CHECK(of_services(record("1016", {"3", "0x007F03E8", "0x000103E8", "0"})) == "");
  CHECK(of_services(record("1016", {"1", "0x00800001"})) ==
        "heartbeat-consumer: 0x00800001 has node-ID 128, not 1 to 127\n");
  CHECK(of_services(record("1016", {"1", "0x01010001"})) ==
        "heartbeat-consumer: 0x01010001 has node-ID 257, not 1 to 127\n");
  CHECK(of_services(record("1016", {"1", "0x00000001"})) ==
        "heartbeat-consumer: 0x00000001 has node-ID 0, not 1 to 127\n");
  CHECK(of_services(record("1016", {"2", "0x00050001", "0x00050002"})) ==
        "heartbeat-consumer-twice: second entry for node 5\n");
  CHECK(of_services(record("1016", {"2", "0x00050001", "0x00050000"})) == "");
}

TEST_CASE("check: sync-window: must not exceed the cycle") {
  const auto sync = [](const char* cycle, const char* window) {
    return of_services(variable("1006", "7", "rw", cycle) + variable("1007", "7", "rw", window));
  };
  CHECK(sync("1000", "1000") == "");
  CHECK(sync("1000", "1001") == "sync-window: SYNC window 1001 is longer than the cycle 1000 in 1006h\n");
  CHECK(sync("0", "1001") == "");
}

TEST_CASE("check: pdo-multiplexed: sub-index 0 FEh or FFh needs the objects of MPDOs [301: 7.2.2.6]") {
  const auto of_mode = [](const char* mode, const char* type, const std::string& more = "") {
    return found(check::check_multiplexed,
                 record("1800", {"2", "$NODEID+0x180", type}) + record("1A00", {mode}) + more);
  };
  const std::string no_list = "pdo-multiplexed-list: source address mode without scanner list\n";
  CHECK(of_mode("0xFF", "255") == "");
  CHECK(of_mode("0xFE", "254") == no_list);
  CHECK(of_mode("0xFE", "254", record("1FA0", {"1", "1"})) == "");
  CHECK(of_mode("0xFE", "254", record("1FCF", {"1", "1"})) == "");
  CHECK(of_mode("0xFE", "254", record("1FD0", {"1", "1"})) == no_list);
  CHECK(of_mode("0xFF", "253") == "pdo-multiplexed-type: multiplexed PDO with transmission type 253\n");
  CHECK(of_mode("0x40", "1") == "");
  CHECK(of_mode("0xFF", "255", "[DeviceInfo]\nGroupMessaging=0\n") ==
        "pdo-multiplexed: multiplexed PDO, but GroupMessaging is 0\n");
  CHECK(of_mode("0xFF", "255", "[DeviceInfo]\nGroupMessaging=1\n") == "");
  const std::string receiver = record("1400", {"2", "$NODEID+0x200", "255"}) + record("1600", {"0xFE"});
  CHECK(found(check::check_multiplexed, receiver) ==
        "pdo-multiplexed-list: source address mode without dispatching list\n");
  CHECK(found(check::check_multiplexed, receiver + record("1FFF", {"1", "1"})) == "");
  CHECK(found(check::check_multiplexed, receiver + record("1FA0", {"1", "1"})) ==
        "pdo-multiplexed-list: source address mode without dispatching list\n");
}

TEST_CASE("check: od-type-complex, od-unmappable: a value needs a basic type, a mapped object a length") {
  const auto type = [](const char* code, const char* mapping) {
    return found(check::check_structure, variable("2000", code, "rw", "", mapping));
  };
  CHECK(type("0x1B", "1") == "");
  CHECK(type("0x21", "0") == "od-type-complex: data type 0021h is a structure, but this is one value\n");
  CHECK(type("0x0F", "0") == "");
  CHECK(type("0x0F", "1") == "od-unmappable: DOMAIN with PDO mapping\n");
}

TEST_CASE("check: od-array-types: elements of an ARRAY must have one type, except sub-indices 0 and FFh") {
  const auto array = [](const char* kind, const char* last, const char* sub = "2") {
    return found(check::check_structure, std::string("[2000]\nParameterName=x\nObjectType=") + kind +
                                             "\n[2000sub0]\nParameterName=x\nDataType=5\nAccessType=ro\n"
                                             "[2000sub1]\nParameterName=x\nDataType=6\nAccessType=ro\n[2000sub" +
                                             sub + "]\nParameterName=x\nAccessType=ro\nDataType=" + last + "\n");
  };
  CHECK(array("8", "6") == "");
  CHECK(array("8", "7") == "od-array-types: element is UNSIGNED32, but sub-index 1 is UNSIGNED16\n");
  CHECK(array("9", "7") == "");
  CHECK(array("8", "7", "FF") == "");
}

TEST_CASE("check: od-link, od-module-…: links must exist, and modules must add new objects") {
  const std::string module = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=x\n";
  const std::string list = record("1027", {"1", "1"});
  const auto check = [](const std::string& eds) { return found(check::check_structure, eds); };
  const std::string linked = variable("2000", "5", "rw") + "[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n";
  CHECK(check(linked) == "od-link: linked object 2001h does not exist\n");
  CHECK(check(linked + variable("2001", "5", "rw")) == "");
  CHECK(check(linked + module + list + variable("M1Fixed2001", "5", "rw")) == "");
  CHECK(check(module) == "od-module-list: modules are described, but object 1027h is missing\n");
  CHECK(check(module + list + variable("2001", "5", "rw") + variable("M1Fixed2001", "5", "rw")) ==
        "od-module-object: module 1 defines an object of the bus coupler\n");
  CHECK(check(module + list + "[ConnectedModules]\nNrOfEntries=2\n1=1\n2=0\n") == "");
  CHECK(check(module + list + "[ConnectedModules]\nNrOfEntries=1\n1=2\n") ==
        "od-module-number: connected module 2 is not described\n");
}

TEST_CASE("check: od-former, od-store-pair, od-granularity: obsolete objects, missing pairs, PDO widths are reported") {
  const auto check = [](const std::string& eds) { return found(check::check_structure, eds); };
  for (const char* const index : {"1004", "100B", "100E", "100F"}) {
    CHECK(check(variable(index, "7", "ro")) == "od-former: object is no longer defined by CiA 301\n");
  }
  CHECK(check(record("1010", {"1", "1"}) + record("1011", {"1", "1"})) == "");
  CHECK(check(record("1010", {"1", "1"})) == "");
  CHECK(check(record("1010", {"2", "1", "1"}) + record("1011", {"1", "1"})) ==
        "od-store-pair: sub-indexes differ from those of 1010h\n");
  CHECK(check("[DeviceInfo]\nGranularity=64\n") == "");
  CHECK(check("[DeviceInfo]\nGranularity=65\n") == "od-granularity: granularity 65 is above 64 bits\n");
}

TEST_CASE("check: od-sub-zero-large: must not exceed the highest sub-index, except for a count of used ones") {
  const auto zero = [](const char* index, const char* access, const char* value) {
    return found(check::check_objects, std::string("[") + index + "]\nParameterName=x\nObjectType=8\n[" + index +
                                           "sub0]\nParameterName=x\nDataType=5\nAccessType=" + access +
                                           "\nDefaultValue=" + value + "\n[" + index +
                                           "sub2]\nParameterName=x\nDataType=5\nAccessType=ro\n");
  };
  CHECK(zero("2000", "ro", "2") == "");
  CHECK(zero("2000", "ro", "3") == "od-sub-zero-large: sub-index 0 is 3, but the highest sub-index is 2\n");
  CHECK(zero("2000", "rw", "3") == "");
  CHECK(zero("1003", "ro", "8") == "");
}

TEST_CASE("check: od-standard-…: communication objects must agree with CiA 301 [301: 7.5.2]") {
  const auto check = [](const std::string& eds) { return found(check::check_standard, eds); };
  const auto other_type = [](const char* type, const char* right) {
    return std::string("od-standard-type: data type ") + type + ", but CiA 301 defines " + right + "\n";
  };
  CHECK(check(variable("1000", "7", "ro") + variable("1001", "5", "ro") + variable("1008", "9", "const") +
              variable("1017", "6", "rw") + variable("2000", "6", "rw")) == "");
  CHECK(check(variable("1000", "6", "ro")) == other_type("UNSIGNED16", "UNSIGNED32"));
  CHECK(check(variable("1008", "0xA", "const")) == other_type("OCTET_STRING", "VISIBLE_STRING"));
  CHECK(check(variable("1017", "7", "rw")) == other_type("UNSIGNED32", "UNSIGNED16"));
  CHECK(check(record("1018", {"4", "1", "1", "1", "1"})) == "");
  CHECK(check(record("1800", {"2", "$NODEID+0x180", "255"})) ==
        other_type("UNSIGNED32", "UNSIGNED8"));  // the transmission type has 32 bits here
  CHECK(check(record("1A00", {"1", "0x20000010"})) == "");
  CHECK(check(record("1003", {"1", "0"})) == "od-standard-kind: object type RECORD, but CiA 301 defines ARRAY\n");
  CHECK(check("[1010]\nParameterName=x\n[1010sub1]\nParameterName=x\nDataType=7\nAccessType=rw\n") == "");
}

TEST_CASE("check: profile-…: objects of CiA 401 and CiA 402 must agree with these profiles") {
  const auto io = [](const Device& device, Findings& findings) { check::check_profile(device, 401, findings); };
  const auto drive = [](const Device& device, Findings& findings) { check::check_profile(device, 402, findings); };
  const auto array = [](const std::string& index, const std::string& type, const std::string& access) {
    return "[" + index + "]\nParameterName=x\nObjectType=8\n[" + index +
           "sub0]\nParameterName=x\nDataType=5\nAccessType=ro\n[" + index + "sub1]\nParameterName=x\nDataType=" + type +
           "\nAccessType=" + access + "\n";
  };
  const std::string words = variable("6040", "6", "rww") + variable("6041", "6", "ro");
  CHECK(found(io, words) == "");
  CHECK(found(drive, words) == "");
  CHECK(found(drive, variable("6041", "6", "ro")) ==
        "profile-object-missing: profile 402, but controlword 6040h is missing\n");
  CHECK(found(drive, words + variable("6060", "5", "rw")) ==
        "profile-type: data type UNSIGNED8, but CiA 402 defines INTEGER8\n");
  CHECK(found(drive, words + variable("607A", "4", "ro")) ==
        "profile-access: access ro, but masters write this object of CiA 402\n");
  CHECK(found(drive, words + variable("6064", "4", "rw")) ==
        "profile-access: access rw, but masters only read this object of CiA 402\n");
  CHECK(found(drive, words + variable("6081", "7", "ro")) == "");  // a parameter may be constant
  CHECK(found(drive, words + array("6064", "4", "ro")) == "profile-kind: object type ARRAY, but CiA 402 defines VAR\n");
  CHECK(found(io, array("6000", "5", "ro") + array("6411", "3", "rww") + variable("6423", "1", "rw")) == "");
  CHECK(found(io, array("6401", "6", "ro")) == "profile-type: data type UNSIGNED16, but CiA 401 defines INTEGER16\n");
  CHECK(found(io, variable("1000", "7", "ro", "0x00030191") + array("6000", "5", "ro")) ==
        "profile-object-missing: bit 17 announces digital outputs, but 6200h is missing\n");
}

TEST_CASE("check: the profile is the lower half of object 1000h; an unknown one is not checked") {
  CHECK(check::profile_of(device_of(variable("1000", "7", "ro", "0x00020192"))) == 402);
  CHECK(check::profile_of(device_of(variable("1000", "7", "ro", ""))) == 0);
  CHECK(check::profile_of(device_of(variable("1001", "5", "ro", "1"))) == 0);
  const auto of = [](const Device& device, Findings& findings) { check::check_profile(device, 410, findings); };
  CHECK(found(of, variable("6040", "5", "ro")) == "");
}
