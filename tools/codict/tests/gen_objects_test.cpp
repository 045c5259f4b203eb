// SPDX-License-Identifier: Apache-2.0
// Objects of the communication profile with types of their own in generated dictionaries: 1002h, the device's own EDS
// (1021h, 1022h), OS command, debugger and prompt (1023h to 1026h), module list (1027h), and error status bits.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "eds/write.hpp"
#include "generating.hpp"

using namespace lexican::codict;

using test::generate;
using test::Generated;
using test::record;
using test::sub;
using test::variable;

namespace {

const std::string type_object = variable("1000", 7, "ro", "DefaultValue=0");

std::string domain(const char* index, const char* access) {
  return fmt::format("[{}]\nParameterName=Store EDS\nObjectType=2\nDataType=15\nAccessType={}\n", index, access);
}

Generated with_eds(const std::string& eds, gen::EmbeddedEds form) {
  gen::Options options;
  options.embedded_eds = form;
  return generate(eds, options);
}

// Returns the bytes of the EDS in a generated source.
std::string embedded(const Generated& generated) {
  const std::string& source = generated.source();
  const std::size_t begin = source.find("{", source.find("static const uint8_t bytes_1021_0[")) + 1;
  const std::size_t end = source.find("};", begin);
  std::string bytes;
  for (std::size_t at = source.find("0x", begin); at < end; at = source.find("0x", at + 1)) {
    bytes += static_cast<char>(std::stoul(source.substr(at + 2, 2), nullptr, 16));
  }
  return bytes;
}

std::string inflated(const std::string& compressed) {
  std::string bytes(1U << 16, '\0');
  uLongf size = bytes.size();
  REQUIRE(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(compressed.data()),
                       compressed.size()) == Z_OK);
  bytes.resize(size);
  return bytes;
}

std::string eds_of(const Generated& generated) {
  Device device = generated.output.device;
  device.file.file_name.text = "small.eds";
  device.file.file_name.is_given = true;
  return eds::write(device, eds::WriteOptions());
}

}  // namespace

TEST_CASE("gen: an object of a range type has its base type and limits; the type has no entry") {
  const test::Generated generated = test::generate(test::fixture_text("range_type.eds"));
  CHECK(generated.has("uint16_t od_2040_0"));
  CHECK(generated.has("limits"));
  CHECK_FALSE(generated.has("SMALL_00B2"));
  CHECK(generated.notes.find("gen-left-out") != std::string::npos);
}

TEST_CASE("gen: 1002h is a variable that the stack writes whatever its access and default value") {
  for (const char* const access : {"ro", "const"}) {
    const Generated generated = generate(variable("1002", 7, access, "PDOMapping=1"));
    CHECK(generated.found == "");
    CHECK(generated.has("{SMALL_1002_0 | CO_OBJ____PR_, CO_TUNSIGNED32, (CO_DATA)(&small_ram.od_1002_0)},"));
  }
}

TEST_CASE("gen: the embedded EDS is that of the generated dictionary and 1022h is its format") {
  const std::string description =
      type_object + domain("1021", "ro") + variable("1022", 6, "ro") + variable("2000", 5, "rw", "DefaultValue=7");
  const Generated plain = with_eds(description, gen::EmbeddedEds::plain);
  CHECK(plain.found == "");
  CHECK(plain.has("{SMALL_1021_0 | CO_OBJ_____R_, CO_TDOMAIN_RO, (CO_DATA)(&eds_1021_0)},"));
  CHECK(plain.has("static CO_OBJ_DOM_RO eds_1021_0 = {0, sizeof bytes_1021_0, bytes_1021_0};"));
  CHECK(plain.has("{SMALL_1022_0 | CO_OBJ_D___R_, CO_TUNSIGNED16, (CO_DATA)(0u)},"));
  CHECK(embedded(plain) == eds_of(plain));
  CHECK(embedded(plain).find("FileName=small.eds") != std::string::npos);

  const Generated zlib = with_eds(description, gen::EmbeddedEds::zlib);
  CHECK(zlib.has("{SMALL_1022_0 | CO_OBJ_D___R_, CO_TUNSIGNED16, (CO_DATA)(128u)},"));
  CHECK(embedded(zlib).size() < embedded(plain).size());
  CHECK(inflated(embedded(zlib)) == eds_of(zlib));
}

TEST_CASE("gen: an embedded EDS adds 1021h and 1022h to a description without them") {
  const Generated generated = with_eds(type_object, gen::EmbeddedEds::zlib);
  CHECK(generated.found == "");
  CHECK(generated.has("{SMALL_1021_0 | CO_OBJ_____R_, CO_TDOMAIN_RO, (CO_DATA)(&eds_1021_0)},"));
  CHECK(generated.has("{SMALL_1022_0 | CO_OBJ_D___R_, CO_TUNSIGNED16, (CO_DATA)(128u)},"));
  const std::string eds = inflated(embedded(generated));
  CHECK(eds == eds_of(generated));
  CHECK(eds.find("[1021]\r\nParameterName=Store EDS\r\nObjectType=0x2\r\n") != std::string::npos);
}

TEST_CASE("gen: a writable or described 1021h is replaced by the embedded EDS and used without it") {
  const std::string described =
      domain("1021", "rw") + "DefaultValue=01 02\n" + variable("1022", 6, "ro", "DefaultValue=1");
  CHECK(with_eds(described, gen::EmbeddedEds::plain).has("{SMALL_1021_0 | CO_OBJ_____R_, CO_TDOMAIN_RO,"));
  CHECK(with_eds(described, gen::EmbeddedEds::plain).has("CO_TUNSIGNED16, (CO_DATA)(0u)},"));
  CHECK(generate(described).has("{SMALL_1021_0 | CO_OBJ_____RW, CO_TDOMAIN, (CO_DATA)(&small_ram.od_1021_0)},"));
  CHECK(generate(described).has("CO_TUNSIGNED16, (CO_DATA)(1u)},"));
}

TEST_CASE("gen: without an embedded EDS the application defines the bytes of 1021h") {
  const Generated generated = generate(domain("1021", "ro"));
  CHECK(generated.has("extern CO_OBJ_DOM_RO small_1021_0;\n"));
  CHECK(generated.has("{SMALL_1021_0 | CO_OBJ_____R_, CO_TDOMAIN_RO, (CO_DATA)(&small_1021_0)},"));
  CHECK(generated.output.stubs.find("CO_OBJ_DOM_RO small_1021_0 = {0, 0, small_1021_0_bytes};") != std::string::npos);
}

TEST_CASE("gen: the costs contain the bytes of the EDS") {
  const Generated generated = with_eds(type_object, gen::EmbeddedEds::plain);
  std::uint64_t flash = 0;
  for (const gen::Cost& cost : generated.output.costs) {
    flash += cost.part == "constants" ? cost.flash : 0;
  }
  CHECK(flash == embedded(generated).size());
}

TEST_CASE("gen: OS command and debugger and prompt are structures that the application defines") {
  const std::string command = [] {
    std::string text;
    for (const char* const index : {"1023", "1025"}) {
      const auto name = [index](int number) { return fmt::format("{}sub{}", index, number); };
      text += record(index) + sub(name(0).c_str(), 5, "const", "3") + sub(name(1).c_str(), 10, "rw", "") +
              sub(name(2).c_str(), 5, "ro", "0") + sub(name(3).c_str(), 10, "ro", "");
    }
    return text;
  }();
  const std::string prompt = record("1026") + sub("1026sub0", 5, "const", "3") + sub("1026sub1", 5, "wo", "") +
                             sub("1026sub2", 5, "ro", "") + sub("1026sub3", 5, "ro", "");
  const Generated generated = generate(command + variable("1024", 5, "wo") + prompt);
  CHECK(generated.found == "");
  for (const char* const line :
       {"{SMALL_1023_0 | CO_OBJ_D___R_, CO_TUNSIGNED8, (CO_DATA)(3u)},",
        "{SMALL_1023_1 | CO_OBJ_____RW, CO_TOS_COMMAND, (CO_DATA)(&small_1023)},",
        "{SMALL_1023_2 | CO_OBJ_____R_, CO_TOS_STATUS, (CO_DATA)(&small_1023)},",
        "{SMALL_1023_3 | CO_OBJ_____R_, CO_TOS_REPLY, (CO_DATA)(&small_1023)},",
        "{SMALL_1024_0 | CO_OBJ______W, CO_TOS_MODE, (CO_DATA)(&small_1023)},",
        "{SMALL_1025_1 | CO_OBJ_____RW, CO_TOS_COMMAND, (CO_DATA)(&small_1025)},",
        "{SMALL_1026_1 | CO_OBJ______W, CO_TOS_STDIN, (CO_DATA)(&small_1026)},",
        "{SMALL_1026_3 | CO_OBJ_____R_, CO_TOS_STDOUT, (CO_DATA)(&small_1026)},", "#if !USE_OBJ_EX\n",
        "extern CO_OS_COMMAND small_1023;\nextern CO_OS_COMMAND small_1025;\nextern CO_OS_PROMPT small_1026;\n"}) {
    CAPTURE(line);
    CHECK(generated.has(line));
  }
  CHECK(generated.output.externals.size() == 3);
  const std::string& stubs = generated.output.stubs;
  CHECK(stubs.find("CO_OS_COMMAND small_1023 = CO_OS_COMMAND_OF(small_1023_command, small_1023_reply, NULL, NULL);") !=
        std::string::npos);
  CHECK(stubs.find("CO_OS_PROMPT small_1026 = CO_OS_PROMPT_OF(NULL, small_1026_out, small_1026_err);") !=
        std::string::npos);
}

TEST_CASE("gen: another data type of the OS command is corrected") {
  const Generated generated =
      generate(record("1023") + sub("1023sub0", 5, "const", "3") + sub("1023sub1", 9, "rw", "text"));
  CHECK(generated.says("gen-place: data type differs from OCTET_STRING of CiA 301, which is used"));
  CHECK(generated.has("{SMALL_1023_1 | CO_OBJ_____RW, CO_TOS_COMMAND, (CO_DATA)(&small_1023)},"));
}

TEST_CASE("gen: a module list is a function of the application unless it has default values") {
  const auto list = [](const char* type) {
    return record("1027") + sub("1027sub0", 5, "ro", "2") + sub("1027sub1", 6, "ro", type) +
           sub("1027sub2", 6, "ro", "");
  };
  const Generated generated = generate(list(""));
  CHECK(generated.has("{SMALL_1027_0 | CO_OBJ_____R_, CO_TMODULE_LIST, (CO_DATA)(&small_1027)},"));
  CHECK(generated.has("{SMALL_1027_2 | CO_OBJ_____R_, CO_TMODULE_LIST, (CO_DATA)(&small_1027)},"));
  CHECK(generated.has("extern const CO_MODULE_LIST small_1027;\n"));
  CHECK(generated.output.stubs.find("const CO_MODULE_LIST small_1027 = {small_1027_read};") != std::string::npos);
  CHECK(generate(list("5")).has("{SMALL_1027_1 | CO_OBJ_____R_, CO_TUNSIGNED16,"));
}

TEST_CASE("gen: an octet string shows error status bits if the options say so") {
  gen::Options options;
  options.error_bits = {0x21000000, 0x21010000, 0x21020000};
  const Generated generated = generate(variable("2100", 10, "ro", "PDOMapping=1\nDefaultValue=00 00 00 00") +
                                           variable("2101", 10, "rw") + variable("2103", 10, "ro", "DefaultValue=00"),
                                       options);
  CHECK(generated.has("static CO_EMCY_BITS bits_2100_0 = {0, 4, 0};"));
  CHECK(generated.has("{SMALL_2100_0 | CO_OBJ____PR_, CO_TEMCY_BITS, (CO_DATA)(&bits_2100_0)},"));
  CHECK(generated.has("#if !USE_EMCY\n"));
  CHECK(generated.has("{SMALL_2101_0 | CO_OBJ_____RW, CO_TOCTET_STRING,"));
  CHECK(generated.has("{SMALL_2103_0 | CO_OBJ_____R_, CO_TOCTET_STRING,"));
  options.error_bits = {0x21000000};
  CHECK(generate(variable("2100", 10, "ro"), options).has("static CO_EMCY_BITS bits_2100_0 = {0, 0, 0};"));
}
