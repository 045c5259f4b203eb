// SPDX-License-Identifier: Apache-2.0
// SRDOs and the global fail-safe command [EN 50325-5] in checks, COB-IDs and generated dictionaries.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "check/network.hpp"
#include "eds/document.hpp"
#include "eds/read.hpp"
#include "generating.hpp"
#include "model/cob_id.hpp"
#include "model/srdo.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;

using test::generate;
using test::Generated;
using test::record;
using test::sub;
using test::variable;

namespace {

Device device_of(const std::string& eds) {
  Findings findings;
  const eds::Document document(Source("device.eds", eds), findings);
  return eds::read(document, findings).devices.front();
}

// Returns "rule: text" of each finding, one per line.
std::string found(const std::string& eds) {
  Findings findings;
  check::check_srdos(device_of(eds), findings);
  std::string text;
  for (const Finding& finding : findings.all()) {
    text += fmt::format("{}: {}\n", finding.rule->id, finding.text);
  }
  return text;
}

// Values of an SRDO: sub-indexes 1 to 6, then those of the mapping, 13FEh and 13FFh sub 1. An empty value omits the
// entry.
struct Values {
  std::vector<const char*> parameters = {"1", "25", "20", "254", "0x101", "0x102"};
  std::vector<const char*> mapping = {"2", "0x20000010", "0x20010010"};
  const char* valid = "0xA5";
  const char* signature = "0xAF48";
};

std::string srdo(const Values& values) {
  constexpr int types[] = {5, 6, 5, 5, 7, 7};
  std::string eds = record("1301") + sub("1301sub0", 5, "const", "6");
  for (std::size_t n = 0; n < values.parameters.size(); ++n) {
    const std::string name = fmt::format("1301sub{}", n + 1);
    eds += *values.parameters[n] == '\0' ? "" : sub(name.c_str(), types[n], "rw", values.parameters[n]);
  }
  eds += values.mapping.empty() ? "" : record("1381");
  for (std::size_t n = 0; n < values.mapping.size(); ++n) {
    eds += sub(fmt::format("1381sub{:X}", n).c_str(), n == 0 ? 5 : 7, "rw", values.mapping[n]);
  }
  eds += *values.valid == '\0' ? "" : variable("13FE", 5, "rw", fmt::format("DefaultValue={}", values.valid).c_str());
  eds += *values.signature == '\0'
             ? ""
             : record("13FF") + sub("13FFsub0", 5, "const", "1") + sub("13FFsub1", 6, "rw", values.signature);
  return eds;
}

const std::string objects = variable("2000", 6, "rw", "PDOMapping=1") + variable("2001", 6, "rw", "PDOMapping=1") +
                            variable("2002", 6, "wo", "PDOMapping=1") + variable("2003", 6, "ro", "PDOMapping=1") +
                            variable("2004", 6, "rw", "PDOMapping=0") + variable("2005", 5, "rw", "PDOMapping=1");

std::string with_parameter(std::size_t sub_index, const char* value) {
  Values values;
  values.valid = "0";
  values.signature = "0";
  values.parameters[sub_index - 1] = value;
  return found(srdo(values) + objects);
}

std::string with_mapping(const char* direction, std::vector<const char*> mapping) {
  Values values;
  values.valid = "0";
  values.signature = "0";
  values.parameters[0] = direction;
  values.mapping = std::move(mapping);
  return found(srdo(values) + objects);
}

// CRC-16 (polynomial 1021h, start 0000h) of bytes.
std::uint16_t crc_of(std::initializer_list<unsigned> bytes) {
  unsigned crc = 0;
  for (const unsigned byte : bytes) {
    crc ^= byte << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1 ^ 0x1021U) & 0xFFFFU : crc << 1 & 0xFFFFU;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace

TEST_CASE("srdo: the signature is the CRC of direction, times, COB-IDs and mapping with its sub-indexes") {
  const std::uint16_t expected = crc_of({1, 25,   0,    20,   0x01, 0x01, 0,    0,    0x02, 0x01, 0, 0, 2,  //
                                         1, 0x10, 0x00, 0x00, 0x20, 2,    0x10, 0x00, 0x01, 0x20});
  CHECK(srdo_signature(1, device_of(srdo(Values()) + objects)) == expected);
  CHECK(expected == 0xAF48);
  CHECK_FALSE(srdo_signature(2, device_of(srdo(Values()) + objects)));
}

TEST_CASE("srdo: a complete SRDO has no findings") {
  CHECK(found(srdo(Values()) + objects) == "");
  CHECK(with_mapping("2", {"2", "0x20020010", "0x20010010"}) == "");
  CHECK(with_mapping("2", {"4", "0x20050008", "0x00050008", "0x00060010", "0x20000010"}) == "");
  CHECK(with_parameter(1, "0") == "");
  CHECK(with_parameter(4, " ") == "");
  CHECK(found(variable("1300", 5, "rw", "DefaultValue=1") + objects) == "");
}

TEST_CASE("srdo-parameter: values that the device refuses are reported with the allowed ones") {
  CHECK(with_parameter(1, "3") == "srdo-parameter: SRDO 1 has the invalid direction 3\n");
  CHECK(with_parameter(2, "0") == "srdo-parameter: SRDO 1 has the invalid refresh time 0\n");
  CHECK(with_parameter(3, "0") == "srdo-parameter: SRDO 1 has the invalid validation time 0\n");
  CHECK(with_parameter(4, "255") == "srdo-parameter: SRDO 1 has the invalid transmission type 255\n");
  for (const char* const cob_id : {"0x100", "0x102", "0xFF", "0x181", "0x80000101"}) {
    CAPTURE(cob_id);
    CHECK(with_parameter(5, cob_id).find("srdo-parameter: SRDO 1 has the invalid COB-ID 1 ") == 0);
  }
  CHECK(with_parameter(6, "0x104") == "srdo-parameter: SRDO 1 has the invalid COB-ID 2 260\n");
  CHECK(with_parameter(5, "$NODEID+0xFF") == "srdo-parameter: COB-ID $NODEID+0xFF of SRDO 1 depends on the node-ID\n");
}

TEST_CASE("srdo-missing: each missing part of an SRDO is reported") {
  CHECK(with_parameter(3, "") == "srdo-missing: SRDO 1 has no validation time (1301h sub 3)\n");
  Values no_mapping;
  no_mapping.mapping.clear();
  no_mapping.valid = no_mapping.signature = "0";
  CHECK(found(srdo(no_mapping)) == "srdo-missing: SRDO 1 has no mapping parameter\n");
  Values no_signature;
  no_signature.signature = "";
  CHECK(found(srdo(no_signature) + objects) == "srdo-missing: SRDO 1 has no signature: the device does not start it\n");
  Values no_valid;
  no_valid.valid = "";
  CHECK(found(srdo(no_valid) + objects) == "srdo-missing: 13FEh is missing: the device starts no SRDO\n");
}

TEST_CASE("srdo-mapping: pairs of equal length and whole bytes up to 8 are mapped") {
  CHECK(with_mapping("1", {"0"}) == "srdo-mapping: SRDO 1 maps 0 objects\n");
  CHECK(with_mapping("1", {"1", "0x20000010"}) == "srdo-mapping: SRDO 1 maps 1 objects\n");
  CHECK(with_mapping("1", {"18", "0x20000010"}) == "srdo-mapping: SRDO 1 maps 18 objects\n");
  CHECK(with_mapping("1", {"2", "0x20000010"}) == "srdo-mapping: sub-index 0 is 2, but SRDO 1 maps 1 objects\n");
  CHECK(with_mapping("1", {"2", "0x20000010", "0x20050008"}) ==
        "srdo-mapping: inverted data of 8 bits for data of 16 bits\n");
  const Values two;
  std::vector<const char*> many = {"10"};
  many.insert(many.end(), 10, "0x20000010");
  CHECK(with_mapping("1", many) == "srdo-mapping: SRDO 1 has 80 bits, more than 64\n");
}

TEST_CASE("srdo-object: a mapped object exists and has flag P and the right of the direction and its length") {
  CHECK(with_mapping("1", {"2", "0x21000010", "0x20010010"}) == "srdo-object: mapped object 2100h does not exist\n");
  CHECK(with_mapping("1", {"2", "0x20000010", "0x20020010"}) ==
        "srdo-object: SRDO 1 cannot map 2002h 'Value 2002' (access wo, PDO mapping optional)\n");
  CHECK(with_mapping("2", {"2", "0x20000010", "0x20030010"}) ==
        "srdo-object: SRDO 1 cannot map 2003h 'Value 2003' (access ro, PDO mapping optional)\n");
  CHECK(with_mapping("1", {"2", "0x20000010", "0x20040010"}) ==
        "srdo-object: SRDO 1 cannot map 2004h 'Value 2004' (access rw, PDO mapping no)\n");
  CHECK(with_mapping("1", {"2", "0x20000008", "0x20050008"}) ==
        "srdo-object: mapping of 8 bits, but 2000h 'Value 2000' has 16\n");
}

TEST_CASE("srdo-signature: a wrong signature is an error and 0 a warning if 13FEh is A5h") {
  Values values;
  values.signature = "0xAF47";
  const std::string wrong = "srdo-signature: signature AF47h of SRDO 1 differs from AF48h, that of its parameters\n";
  CHECK(found(srdo(values) + objects) == wrong);
  values.valid = "0";
  CHECK(found(srdo(values) + objects) == wrong);
  values.signature = "0";
  CHECK(found(srdo(values) + objects) == "");
  values.valid = "0xA5";
  CHECK(found(srdo(values) + objects) ==
        "srdo-signature-zero: 13FEh is A5h (valid), but the signature of SRDO 1 is 0\n");
  values.parameters[1] = "26";
  values.signature = "0xAF48";
  CHECK(found(srdo(values) + objects).find("srdo-signature: signature AF48h of SRDO 1 differs from ") == 0);
}

TEST_CASE("srdo-pdo: a PDO that maps an object of an SRDO is reported and one that maps a dummy is not") {
  const auto pdo = [](const char* mapping) {
    return record("1400") + sub("1400sub0", 5, "ro", "2") + sub("1400sub1", 7, "rw", "0x201") +
           sub("1400sub2", 5, "rw", "255") + record("1600") + sub("1600sub0", 5, "rw", "1") +
           sub("1600sub1", 7, "rw", mapping);
  };
  CHECK(found(srdo(Values()) + objects + pdo("0x20010010")) ==
        "srdo-pdo: RPDO 1 maps 2001h 'Value 2001', which an SRDO maps, too\n");
  CHECK(found(srdo(Values()) + objects + pdo("0x20020010")) == "");
  Values dummy;
  dummy.mapping = {"2", "0x00060010", "0x20010010"};
  dummy.valid = dummy.signature = "0";
  CHECK(found(srdo(dummy) + objects + pdo("0x00060010")) == "");
}

TEST_CASE("srdo: CO_accessSRDO makes an object mappable in its direction") {
  const auto with = [](const char* access, const char* direction) {
    const auto object = [](const char* index, const char* id) {
      return fmt::format("<CANopenObject index=\"{}\" name=\"Object {}\" objectType=\"7\" uniqueIDRef=\"{}\"/>", index,
                         index, id);
    };
    const auto parts = [](const char* index, std::vector<const char*> ids) {
      std::string text = fmt::format("<CANopenObject index=\"{}\" name=\"Record\" objectType=\"9\">", index);
      for (std::size_t n = 0; n < ids.size(); ++n) {
        text += fmt::format("<CANopenSubObject subIndex=\"{:02X}\" name=\"Sub\" objectType=\"7\" uniqueIDRef=\"{}\"/>",
                            n, ids[n]);
      }
      return text + "</CANopenObject>";
    };
    const auto value = [](const char* id, const char* type, const std::string& number) {
      return fmt::format(
          "<parameter uniqueID=\"{}\" access=\"readWrite\"><{}/><defaultValue value=\"{}\"/></parameter>", id, type,
          number);
    };
    const auto safety = [access](const char* id) {
      return fmt::format(
          "<parameter uniqueID=\"{}\" access=\"readWrite\"><UINT/><defaultValue value=\"0\"/>"
          "<property name=\"CO_accessSRDO\" value=\"{}\"/></parameter>",
          id, access);
    };
    return test::XmlReading(
               test::xdd_with(parts("1301", {"P6", "PD", "P25", "P20", "P254", "P101", "P102"}) +
                                  parts("1381", {"P2", "PA", "PB"}) + object("13FE", "P0") +
                                  parts("13FF", {"P1", "PS"}) + object("2000", "PX") + object("2001", "PY"),
                              value("P6", "USINT", "6") + value("PD", "USINT", direction) + value("P25", "UINT", "25") +
                                  value("P20", "USINT", "20") + value("P254", "USINT", "254") +
                                  value("P101", "UDINT", "0x101") + value("P102", "UDINT", "0x102") +
                                  value("P2", "USINT", "2") + value("PA", "UDINT", "0x20000010") +
                                  value("PB", "UDINT", "0x20010010") + value("P0", "USINT", "0") +
                                  value("P1", "USINT", "1") + value("PS", "UINT", "0") + safety("PX") + safety("PY")))
        .device;
  };
  const auto faults = [&with](const char* access, const char* direction) {
    Findings findings;
    check::check_srdos(with(access, direction), findings);
    return findings.count(check::rules::srdo_object);
  };
  CHECK(faults("tx", "1") == 0);
  CHECK(faults("trx", "1") == 0);
  CHECK(faults("rx", "1") == 2);
  CHECK(faults("rx", "2") == 0);
  CHECK(faults("tx", "2") == 2);
  CHECK(faults("no", "2") == 2);

  gen::Options options;
  options.name = "small";
  Findings findings;
  const gen::Output output = gen::generate(with("tx", "1"), options, findings);
  REQUIRE(output.files.size() == 2);
  CHECK(output.files[1].bytes.find("{SMALL_2000_0 | CO_OBJ____PRW, CO_TUNSIGNED16,") != std::string::npos);
  CHECK(output.device.find(0x2000)->pdo_mapping.value == PdoMapping::optional);
}

TEST_CASE("srdo: the COB-IDs of a device include both frames of its SRDOs and the GFC") {
  std::string text;
  for (const CobId& cob_id :
       cob_ids_of(device_of(variable("1300", 5, "rw", "DefaultValue=1") + srdo(Values()) + objects), 1)) {
    text += cob_id.is_safety ? fmt::format("{} {:03X} {:04X}:{}\n", cob_id.service, cob_id.identifier(), cob_id.index,
                                           cob_id.sub_index)
                             : "";
  }
  CHECK(text == "GFC 001 1300:0\nSRDO 1 transmitted, plain 101 1301:5\nSRDO 1 transmitted, inverse 102 1301:6\n");
  Findings findings;
  check::check_cob_ids(device_of(variable("1300", 5, "rw", "DefaultValue=1") + srdo(Values())), findings);
  CHECK(findings.all().empty());
}

TEST_CASE("gen: an SRDO has the types of the library and needs CO_SRDO_N") {
  const Generated generated = generate(srdo(Values()) + objects);
  CHECK(generated.found == "");
  for (const char* const line : {"{SMALL_1301_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(6u)},",
                                 "{SMALL_1301_1 | CO_OBJ_____RW, CO_TSRDO_COM, (CO_DATA)(&small_ram.od_1301_1)},",
                                 "{SMALL_1301_2 | CO_OBJ_____RW, CO_TSRDO_COM, (CO_DATA)(&small_ram.od_1301_2)},",
                                 "{SMALL_1301_6 | CO_OBJ_____RW, CO_TSRDO_COM, (CO_DATA)(&small_ram.od_1301_6)},",
                                 "{SMALL_1381_0 | CO_OBJ_____RW, CO_TSRDO_MAP, (CO_DATA)(&small_ram.od_1381_0)},",
                                 "{SMALL_1381_2 | CO_OBJ_____RW, CO_TSRDO_MAP, (CO_DATA)(&small_ram.od_1381_2)},",
                                 "{SMALL_13FE_0 | CO_OBJ_____RW, CO_TSRDO_VALID, (CO_DATA)(&small_ram.od_13FE_0)},",
                                 "{SMALL_13FF_1 | CO_OBJ_____RW, CO_TSRDO_SIGNATURE, (CO_DATA)(&small_ram.od_13FF_1)},",
                                 "uint16_t od_1301_2;", "uint8_t od_1301_3;", "#if CO_SRDO_N < 1\n"}) {
    CAPTURE(line);
    CHECK(generated.has(line));
  }
  const Generated fail_safe = generate(variable("1300", 5, "rw", "DefaultValue=1"));
  CHECK(fail_safe.has("{SMALL_1300_0 | CO_OBJ_____RW, CO_TGFC, (CO_DATA)(&small_ram.od_1300_0)},"));
  CHECK(fail_safe.has("#if !USE_GFC\n"));
  CHECK(generate(variable("13FE", 5, "ro", "DefaultValue=0xA5")).has("(CO_DATA)(&small_ram.od_13FE_0)},"));
}

TEST_CASE("gen: a missing signature is filled in and a given one is kept") {
  Values values;
  values.signature = "0";
  const Generated filled = generate(srdo(values) + objects);
  CHECK(filled.found == "");
  CHECK(filled.says("gen-srdo-signature: signature of SRDO 1 is filled in: AF48h"));
  CHECK(filled.has("{44872u},  // od_13FF_1"));
  CHECK(filled.output.device.find(0x13FF)->find(1)->default_value.integer == Integer(0xAF48));
  values.signature = "0x1234";
  const Generated kept = generate(srdo(values) + objects);
  CHECK_FALSE(kept.says("gen-srdo-signature"));
  CHECK(kept.has("{4660u},  // od_13FF_1"));
  values.parameters[0] = "0";
  values.signature = "0";
  CHECK_FALSE(generate(srdo(values) + objects).says("gen-srdo-signature"));
}

TEST_CASE("gen: parameters of an SRDO that are missing have the values of the standard") {
  Values values;
  values.parameters[3] = " ";
  values.mapping[0] = " ";
  const Generated generated = generate(srdo(values) + objects);
  CHECK(generated.has("{254u},  // od_1301_4"));
  CHECK(generated.has("{2u},  // od_1381_0"));
}

TEST_CASE("gen: an object that a constant mapping of an SRDO contains gets flag P") {
  const std::string constant = record("1381") + sub("1381sub0", 5, "const", "2") +
                               sub("1381sub1", 7, "const", "0x20040010") + sub("1381sub2", 7, "const", "0x20000010");
  CHECK(generate(constant + objects).has("{SMALL_2004_0 | CO_OBJ____PRW, CO_TUNSIGNED16,"));
}
