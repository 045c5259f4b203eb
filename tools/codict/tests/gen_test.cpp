// SPDX-License-Identifier: Apache-2.0
// Generated text, and findings for descriptions that cannot be generated.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "gen/gen.hpp"
#include "gen/names.hpp"
#include "generating.hpp"
#include "reading.hpp"

using namespace lexican::codict;

using test::fixture_text;
using test::generate;
using test::Generated;
using test::record;
using test::sub;
using test::variable;

namespace {

const std::string type_object = variable("1000", 7, "ro", "DefaultValue=0");

}  // namespace

TEST_CASE("gen: the files of a small device equal the expected ones") {
  const std::string eds = fixture_text("gen/small.eds");
  for (const gen::Language language : {gen::Language::c, gen::Language::cpp}) {
    gen::Options options;
    options.language = language;
    const Generated generated = generate(eds, options);
    CHECK(generated.found == "");
    CHECK(generated.header() == fixture_text("gen/small_od.h.txt"));
    const bool is_c = language == gen::Language::c;
    CHECK(generated.source() == fixture_text(is_c ? "gen/small_od.c.txt" : "gen/small_od.cpp.txt"));
  }
}

TEST_CASE("gen: input that cannot be generated is an error at its place and no file is written") {
  const std::pair<std::string, const char*> cases[] = {
      {variable("2000", 5, "UNKNOWN"), "5:12 gen-access\n"},
      {variable("2000", 5, "rw", "DefaultValue=300"), "6:14 gen-value\n"},
      {variable("2000", 5, "rw", "DefaultValue=text"), "6:14 gen-value\n"},
      {variable("2000", 1, "rw", "DefaultValue=$NODEID"), "6:14 gen-node-id\n"},
      {variable("1017", 9, "rw", "DefaultValue=text"), "1:2 gen-place\n6:14 gen-value\n"},
      {record("1A00") + sub("1A00sub0", 5, "ro", "2") + sub("1A00sub1", 7, "ro", "0x20000040") +
           sub("1A00sub2", 7, "ro", "0x20000040") + variable("2000", 27, "ro", "PDOMapping=1"),
       "4:2 gen-pdo-bits\n"},
      {variable("1000", 7, "ro") + record("1010") + sub("1010sub0", 5, "ro", "2") + sub("1010sub1", 7, "rw", "1") +
           sub("1010sub2", 7, "rw", "1") + variable("2000", 5, "rw", ";StorageLocation=APP\n"),
       "24:2 gen-store-unused\n31:2 gen-store\n"},
  };
  for (const auto& test_case : cases) {
    CAPTURE(test_case.first);
    const Generated generated = generate(test_case.first);
    CHECK(generated.found == test_case.second);
    CHECK_MESSAGE(generated.output.files.empty(), generated.found);
  }
  CHECK(generate("[FileInfo]\n").found == "1:1 gen-count\n");
}

TEST_CASE("gen: corrections are reported") {
  const std::pair<std::string, const char*> cases[] = {
      {record("2000") + sub("2000sub1", 5, "rw", "1"), "1:2 gen-sub-0\n"},
      {record("1200") + sub("1200sub0", 5, "ro", "2") + sub("1200sub1", 7, "ro", "0x600"), "17:14 gen-cob-id\n"},
      {record("1400") + sub("1400sub0", 5, "ro", "2") + sub("1400sub1", 7, "rw", ""), "11:2 gen-cob-id\n"},
      {variable("2000", 6, "rw", "DefaultValue=1\nLowLimit=5\nHighLimit=9"), "6:14 gen-limits-default\n"},
      {variable("2000", 6, "rw", "LowLimit=9\nHighLimit=5"), "6:10 gen-limits\n"},
      {variable("2000", 7, "rw", "LowLimit=$NODEID+5"), "6:10 gen-limits\n"},
      {record("1A00") + sub("1A00sub0", 5, "ro", "1") + sub("1A00sub1", 7, "ro", "0x20000008"),
       "17:14 gen-pdo-object\n"},
      {record("1A00") + sub("1A00sub0", 5, "ro", "1") + sub("1A00sub1", 7, "ro", "0x20000010") +
           variable("2000", 5, "ro", "PDOMapping=1"),
       "17:14 gen-pdo-object\n"},
      {record("1A00") + sub("1A00sub0", 5, "ro", "1") + sub("1A00sub1", 7, "ro", "0x20000008") +
           variable("2000", 5, "rww", "PDOMapping=1"),
       "17:14 gen-pdo-direction\n"},
      {record("1010") + sub("1010sub0", 5, "ro", "1") + sub("1010sub1", 7, "rw", "1"), "11:2 gen-store-unused\n"},
      {variable("2000", 10, "rw", "DefaultValue=0"), "6:14 gen-value-none\n"},
      {variable("2000", 15, "rw", "DefaultValue=@FILE"), "6:14 gen-value-none\n"},
      {variable("2000", 0x77, "rw", "DefaultValue=5"), "4:10 gen-type\n"},
      {record("1FFF") + variable("2000", 5, "rw"), "1:2 gen-no-subs\n"},
  };
  for (const auto& test_case : cases) {
    CAPTURE(test_case.first);
    const Generated generated = generate(test_case.first);
    CHECK(generated.found == test_case.second);
    CHECK(generated.output.files.size() == 2);
  }
}

TEST_CASE("gen: a communication object has the type of CiA 301, whatever the description contains") {
  const Generated wide = generate(variable("1017", 7, "rw", "DefaultValue=1000"));
  CHECK(wide.found == "1:2 gen-place\n");
  CHECK(wide.has("uint16_t od_1017_0;"));
  const Generated history = generate(record("1003") + sub("1003sub0", 7, "rw", "0") + sub("1003sub1", 0x77, "ro", ""));
  CHECK(history.found == "4:2 gen-place\n11:2 gen-place\n");
  CHECK(history.has("uint8_t od_1003_0;"));
  CHECK(history.has("uint32_t od_1003_1;"));
}

TEST_CASE("gen: an unknown type is defined by the application") {
  const Generated generated = generate(variable("2000", 0x77, "rw", "DefaultValue=5"));
  CHECK(generated.has("extern const CO_OBJ_TYPE small_2000_0_type;\n"));
  CHECK(generated.has("{SMALL_2000_0 | CO_OBJ_____RW, &small_2000_0_type, (CO_DATA)(0)},"));
}

TEST_CASE("gen: a time may be written as days and milliseconds") {
  CHECK(generate(variable("2000", 12, "rw", "DefaultValue=365 43200000")).has("{{0x2932E00u, 365u}},  // od_2000_0\n"));
  for (const char* wrong : {"365 noon", "65536 0", "1 0x10000000", "1 2 3"}) {
    CAPTURE(wrong);
    CHECK(generate(variable("2000", 12, "rw", fmt::format("DefaultValue={}", wrong).c_str())).found ==
          "6:14 gen-value\n");
  }
}

TEST_CASE("gen: with one sub-index in 1010h all storage groups are one group") {
  const std::string store = record("1010") + sub("1010sub0", 5, "ro", "1") + sub("1010sub1", 7, "rw", "1");
  const Generated generated = generate(store + variable("2000", 5, "rw", ";StorageLocation=DRIVE\n") +
                                       variable("2001", 5, "rw", ";StorageLocation=RAM\n") +
                                       variable("2002", 5, "rw", ";StorageLocation=EEPROM\n"));
  CHECK(generated.found == "32:2 gen-store-joined\n");
  CHECK(generated.has("(CO_DATA)(&small_drive.od_2000_0)"));
  CHECK(generated.has("(CO_DATA)(&small_ram.od_2001_0)"));
  CHECK(generated.has("(CO_DATA)(&small_drive.od_2002_0)"));
  CHECK_FALSE(generated.has("eeprom"));
}

TEST_CASE("gen: entries with equal names get their index appended; --unique-names forbids it and reports both") {
  const std::string eds =
      "[2000]\nParameterName=Speed\nDataType=5\nAccessType=rw\n"
      "[2001]\nParameterName=speed\nDataType=5\nAccessType=rw\n";
  const Generated generated = generate(eds);
  CHECK(generated.notes == "1:2 gen-name-shared\n5:2 gen-name-shared\n");
  CHECK(generated.has("#define SMALL_SPEED_2000_0 SMALL_2000_0\n"));
  CHECK(generated.has("union { uint8_t od_2001_0; uint8_t speed_2001_0; };"));
  gen::Options options;
  options.unique_names = true;
  CHECK(generate(eds, options).found == "1:2 gen-name\n5:2 gen-name\n");
}

TEST_CASE("gen: names used by the generated dictionary are not given to entries") {
  const char* const names[] = {"OD NUM", "Para base", "Drive layout", "unused"};
  std::string eds = variable("1FFF", 5, "rw", ";StorageLocation=DRIVE\n");
  for (int n = 0; n < 4; ++n) {
    eds += fmt::format("[200{}]\nParameterName={}\nDataType=5\nAccessType=rw\n", n, names[n]);
  }
  const Generated generated = generate(eds);
  for (const char* macro : {"OD_NUM_2000_0", "PARA_BASE_2001_0", "DRIVE_LAYOUT_2002_0", "UNUSED_2003_0"}) {
    CHECK(generated.has(fmt::format("#define SMALL_{} SMALL_200", macro)));
  }
}

TEST_CASE("gen: a disabled object and a type definition have no entry and a note") {
  const Generated generated =
      generate("[5]\nParameterName=Dummy\nObjectType=5\nDataType=5\nAccessType=ro\n" + type_object);
  CHECK(generated.notes == "1:2 gen-left-out\n");
  CHECK(generated.has("#define SMALL_OD_NUM 1 "));
}

TEST_CASE("gen: a configured value replaces the default value") {
  const Generated generated = generate(variable("2000", 5, "const", "DefaultValue=1\nParameterValue=2"));
  CHECK(generated.has("{SMALL_2000_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(2u)},"));
}

TEST_CASE("gen: a configuration that is too small stops the compiler") {
  const Generated generated = generate(record("1402") + sub("1402sub0", 5, "ro", "2") + variable("1012", 7, "rw"));
  CHECK(generated.has(
      "#if CO_RPDO_N < 3\n#error \"small: the description has RPDO 3, CO_RPDO_N is less: set CO_RPDO_N to 3 (co_cfg.h, "
      "-DCO_RPDO_N=3)\"\n#endif"));
  CHECK(generated.has("#if !USE_TIME\n#error"));
}

TEST_CASE("gen: the default value of a writable string does not limit its length") {
  constexpr int visible_string = 9;
  constexpr const char* text = "DefaultValue=cellar";
  CHECK(generate(variable("2000", visible_string, "rw", text)).has("uint8_t od_2000_0_memory[33];"));
  CHECK(generate(variable("2000", visible_string, "ro", text)).has("text_2000_0[] = \"cellar\";"));
  gen::Options options;
  options.string_capacity = 4;
  CHECK(generate(variable("2000", visible_string, "rw", text), options).has("uint8_t od_2000_0_memory[7];"));
}

TEST_CASE("gen: limits equal to the range of the type need no type of their own") {
  CHECK_FALSE(generate(variable("2000", 5, "rw", "LowLimit=0\nHighLimit=255")).has("limits_1"));
  CHECK_FALSE(generate(variable("2000", 3, "rw", "LowLimit=-32768\nHighLimit=0x7FFF")).has("limits_1"));
  CHECK(generate(variable("2000", 3, "rw", "LowLimit=-32767")).has("limits_1"));
  CHECK_FALSE(generate(variable("2000", 3, "ro", "LowLimit=5")).has("limits_1"));
}

TEST_CASE("gen: entries with equal limits share a type") {
  const char* const limits = "DefaultValue=3\nLowLimit=2\nHighLimit=9";
  const Generated generated = generate(variable("2000", 6, "rw", limits) + variable("2001", 6, "rw", limits));
  CHECK(generated.has("limits_1"));
  CHECK_FALSE(generated.has("limits_2"));
}

TEST_CASE("gen: the version of a stored layout changes only with its entries") {
  const std::string store = record("1010") + sub("1010sub0", 5, "ro", "1") + sub("1010sub1", 7, "rw", "1");
  const auto layout_of = [&](const std::string& variables) {
    const std::string header = generate(store + variables).header();
    const std::size_t at = header.find("_LAYOUT 0x");
    REQUIRE(at != std::string::npos);
    return header.substr(at, 16);
  };
  const std::string layout = layout_of(variable("2000", 5, "rw", ";StorageLocation=APP\n"));
  CHECK(layout == layout_of(variable("2000", 5, "ro", "DefaultValue=7\n;StorageLocation=APP\n")));
  CHECK(layout != layout_of(variable("2000", 2, "rw", ";StorageLocation=APP\n")));
  CHECK(layout != layout_of(variable("2001", 5, "rw", ";StorageLocation=APP\n")));
}

TEST_CASE("gen: resets copy the default values beginning with the first variable that they set") {
  const Generated generated =
      generate(variable("2001", 7, "rw") + variable("2000", 6, "ro") + variable("1005", 7, "rw", "DefaultValue=0x80") +
               variable("1017", 6, "rw", "DefaultValue=5") + variable("2002", 6, "rwr"));
  CHECK(
      generated.has("typedef struct small_ram_t_ {\n"
                    "  union { uint16_t od_2000_0; uint16_t value_2000; };  ///< Value 2000, UNSIGNED16 ro\n"
                    "  union { uint16_t od_2002_0; uint16_t value_2002; };  ///< Value 2002, UNSIGNED16 rwr\n"
                    "  union { uint32_t od_2001_0; uint32_t value_2001; };  ///< Value 2001, UNSIGNED32 rw\n"
                    "  union { uint32_t od_1005_0; uint32_t value_1005; };  ///< Value 1005, UNSIGNED32 rw\n"
                    "  union { uint16_t od_1017_0; uint16_t value_1017; };  ///< Value 1017, UNSIGNED16 rw\n"
                    "} small_ram_t;"));
  CHECK(generated.has("reset == CO_RESET_NODE ? offsetof(small_ram_t, od_2002_0) : offsetof(small_ram_t, od_1005_0);"));
  CHECK(generated.has("\nsmall_ram_t small_ram;\nstatic const small_ram_t small_ram_default = {\n"));
  CHECK(generated.has("  small_ram = small_ram_default;\n"));
  CHECK(generated.has("    {CO_DEFAULTS_KEY, &power_on_type, (CO_DATA)(0)},\n};"));
  CHECK(generated.has("#define SMALL_OD_NUM 6 "));
}

TEST_CASE("gen: reset communication sets nothing if SDO can write no communication object") {
  const Generated generated = generate(variable("1001", 5, "ro") + variable("2000", 5, "rw"));
  CHECK(generated.has("reset == CO_RESET_NODE ? offsetof(small_ram_t, od_2000_0) : sizeof small_ram;"));
}

TEST_CASE("gen: objects that SDO can only read are initialised by the compiler; 1003h belongs to the stack") {
  const Generated generated = generate(type_object + variable("1001", 5, "ro") + record("1003") +
                                       sub("1003sub0", 5, "rw", "0") + sub("1003sub1", 7, "ro", ""));
  CHECK(generated.has("small_ram_t small_ram = {"));
  CHECK_FALSE(generated.has("power_on_type"));
  CHECK(generated.has("void small_set_defaults(void);"));
}

TEST_CASE(
    "gen: reset communication loads the first bytes of a storage group: its objects of the communication profile") {
  const std::string store = record("1010") + sub("1010sub0", 5, "ro", "1") + sub("1010sub1", 7, "rw", "1");
  const char* const group = ";StorageLocation=APP\n";
  const Generated mixed = generate(store + variable("1017", 6, "rw", group) + variable("2000", 7, "rw", group) +
                                   variable("2001", 5, "rw", group));
  CHECK(mixed.has("CO_RESET_NODE, NULL, CO_PARA___E | CO_PARA_VERSION(SMALL_APP_LAYOUT), 2, 0};"));
  CHECK(
      mixed.has("typedef struct small_app_t_ {\n"
                "  union { uint16_t od_1017_0; uint16_t value_1017; };  ///< Value 1017, UNSIGNED16 rw\n"
                "  uint8_t unused_com[2];\n"
                "  union { uint32_t od_2000_0; uint32_t value_2000; };  ///< Value 2000, UNSIGNED32 rw\n"
                "  union { uint8_t od_2001_0; uint8_t value_2001; };  ///< Value 2001, UNSIGNED8 rw\n"
                "  uint8_t unused[3];\n"
                "} small_app_t;"));
  CHECK(mixed.has("offsetof(small_app_t, od_2000_0) == 4 "));
  CHECK(generate(store + variable("1017", 6, "rw", group))
            .has("CO_RESET_COM, NULL, CO_PARA___E | CO_PARA_VERSION(SMALL_APP_LAYOUT), 0, 0};"));
  CHECK(generate(store + variable("2000", 6, "rw", ";StorageLocation=COMM\n"))
            .has("CO_RESET_NODE, NULL, CO_PARA___E | CO_PARA_VERSION(SMALL_COMM_LAYOUT), 0, 0};"));
}

TEST_CASE("gen: a storage group that no 1010h loads has its default values") {
  const char* const group = "DefaultValue=5\n;StorageLocation=APP\n";
  const Generated generated = generate(variable("1017", 6, "rw", group) + variable("2000", 7, "rw", group));
  CHECK(generated.has("memcpy(&small_app, &small_app_default, reset == CO_RESET_NODE ? sizeof small_app : 2);"));
  CHECK(generated.has("power_on_type"));
}

TEST_CASE("gen: the RAM size includes padding between variables for 32-bit addresses") {
  // 1 byte, 4 of the domain, 3 padding, 12 of its CO_OBJ_DOM, 4 padding, 8
  const std::string octets = variable("2000", 15, "rw", "DefaultValue=01020304");
  const auto wide_at = [](const char* index) { return variable(index, 0x1B, "rw", "DefaultValue=1"); };
  const std::string wide = wide_at("2001");
  const Generated generated = generate(octets + wide + variable("2002", 5, "rw"));
  REQUIRE(generated.output.costs.at(0).part == "RAM");
  CHECK(generated.output.costs.at(0).ram == 32);
  CHECK(generated.output.costs.at(0).flash == 32);
  // 8 and 1 not writable by the network, 7 padding, 8 set by reset node, 1 set by both resets, 7 padding
  CHECK(generate(variable("2000", 0x1B, "ro") + variable("2001", 5, "ro") + wide_at("2002") + variable("100D", 5, "rw"))
            .output.costs.at(0)
            .ram == 32);
  // 4 of the domain, 12 of its CO_OBJ_DOM, 8
  CHECK(generate(octets + wide).output.costs.at(0).ram == 24);
  // 8, 12 of the CO_OBJ_DOM, 4 of the domain: members that the network cannot write are in descending order
  CHECK(generate(variable("2000", 15, "ro", "DefaultValue=01020304") + variable("2001", 0x1B, "ro"))
            .output.costs.at(0)
            .ram == 24);
}

TEST_CASE("gen: an object gets flag P if a constant mapping in use names it, so that CO_OD_CHECK() accepts the table") {
  const auto flags = [](const char* number_access, const char* number, const char* mapping_access) {
    const Generated generated = generate(record("1A00") + sub("1A00sub0", 5, number_access, number) +
                                         sub("1A00sub1", 7, mapping_access, "0x20000010") + variable("2000", 6, "rw"));
    return generated.has("{SMALL_2000_0 | CO_OBJ____PRW,");
  };
  CHECK(flags("const", "1", "const"));
  CHECK(flags("rw", "0", "const"));
  CHECK_FALSE(flags("const", "0", "const"));
  CHECK_FALSE(flags("const", "0xFF", "const"));
  CHECK_FALSE(flags("rw", "1", "rw"));
}

TEST_CASE("gen: words are converted to identifiers of C") {
  CHECK(gen::identifier("Time of day (UTC)") == "time_of_day_utc");
  CHECK(gen::identifier("  2nd  ") == "n2nd");
  CHECK(gen::identifier("default") == "default_");
  CHECK(gen::identifier("uint8_t") == "uint8_t_");
  CHECK(gen::identifier("\xC3\x9C"
                        "ber") == "ber");
  CHECK(gen::identifier("---") == "");
  CHECK(gen::default_name("/a.b/Drive (2).v3.eds") == "drive_2_v3");
  CHECK(gen::default_name("\xE2\x82\xAC.eds") == "device");
}

TEST_CASE("gen: special characters in comments and strings of C are escaped") {
  CHECK(gen::comment_text("*/ \\ ?\?/ \n") == "./ . ../ .");
  CHECK(gen::string_literal("a\"\\\n1?") == "\"a\\042\\134\\0121\\077\"");
}
