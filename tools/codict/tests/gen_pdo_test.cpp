// SPDX-License-Identifier: Apache-2.0
// PDOs of a description that the stack does not create: they are disabled in the generated dictionary.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "generating.hpp"

using namespace lexican::codict;

using test::generate;
using test::Generated;
using test::record;
using test::sub;
using test::variable;

namespace {

// Returns TPDO 3 or RPDO 3 with these mapping entries.
std::string pdo(char direction, const char* cob_id, const char* number, const std::vector<const char*>& mapped) {
  const bool sends = direction == 'T';
  const std::string communication = sends ? "1802" : "1402";
  const std::string mapping = sends ? "1A02" : "1602";
  std::string eds = record(communication.c_str()) + sub((communication + "sub0").c_str(), 5, "ro", "2") +
                    sub((communication + "sub1").c_str(), 7, "rw", cob_id) +
                    sub((communication + "sub2").c_str(), 5, "rw", "255") + record(mapping.c_str()) +
                    sub((mapping + "sub0").c_str(), 5, "rw", number);
  for (std::size_t n = 0; n < mapped.size(); ++n) {
    eds += sub(fmt::format("{}sub{:X}", mapping, n + 1).c_str(), 7, "rw", mapped[n]);
  }
  return eds;
}

const std::string objects = variable("2000", 6, "rw", "PDOMapping=1") + variable("2001", 6, "wo", "PDOMapping=1") +
                            variable("2002", 6, "ro", "PDOMapping=1") + variable("2003", 1, "rw", "PDOMapping=1");

std::string configuration_of(const Generated& generated) {
  const std::string& source = generated.source();
  const std::size_t begin = source.find("small_ram_default = {");
  return source.substr(begin, source.find("};", begin) - begin);
}

bool is_off(const Generated& generated) {
  return !generated.output.files.empty() && generated.found.find("gen-pdo-off\n") != std::string::npos &&
         configuration_of(generated).find("{0x800001") != std::string::npos;
}

}  // namespace

TEST_CASE("gen: a PDO with a correct mapping stays on") {
  for (const char direction : {'T', 'R'}) {
    const Generated generated = generate(pdo(direction, "$NODEID+0x180", "2", {"0x20000010", "0x20030008"}) + objects);
    CHECK(generated.found == "");
    CHECK_FALSE(is_off(generated));
  }
  // An RPDO may contain dummy entries.
  CHECK(generate(pdo('R', "$NODEID+0x180", "2", {"0x00050008", "0x20000010"}) + objects).found == "");
  // The PDO is disabled in the description.
  CHECK(generate(pdo('T', "$NODEID+0x80000180", "0", {}) + objects).found == "");
}

TEST_CASE("gen: a PDO that maps no object or an unmappable one is switched off and reported with the reason") {
  struct Case {
    char direction;
    const char* number;
    std::vector<const char*> mapped;
    const char* text;
  };
  const Case cases[] = {
      {'T', "0", {"0x20000010"}, "TPDO 3 is switched off (bit 31 of 1802h sub 1): 1A02h sub 0 is 0: it maps no object"},
      {'R', "0", {}, "RPDO 3 is switched off (bit 31 of 1402h sub 1): 1602h sub 0 is 0: it maps no object"},
      {'T', "2", {"0x20000010"}, "TPDO 3 is switched off (bit 31 of 1802h sub 1): 1A02h sub 2 is missing"},
      {'T', "1", {"0"}, "1A02h sub 1 maps no object"},
      {'T', "1", {"0x21000010"}, "1A02h sub 1 maps 2100h sub 0, which has no entry"},
      {'T', "1", {"0x20010010"}, "1A02h sub 1 maps 2001h sub 0 (Value 2001), which cannot be read (wo)"},
      {'R', "1", {"0x20020010"}, "1602h sub 1 maps 2002h sub 0 (Value 2002), which cannot be written (ro)"},
      {'T', "1", {"0x20000008"}, "1A02h sub 1 maps 8 bits of 2000h sub 0 (Value 2000), which has 16"},
      {'T', "1", {"0x20000020"}, "1A02h sub 1 maps 32 bits of 2000h sub 0 (Value 2000), which has 16"},
      {'T', "1", {"0x00050008"}, "1A02h sub 1 maps 0005h sub 0, which has no entry"},
  };
  for (const Case& one : cases) {
    CAPTURE(one.text);
    const Generated generated = generate(pdo(one.direction, "$NODEID+0x180", one.number, one.mapped) + objects);
    CHECK(is_off(generated));
    CHECK_MESSAGE(generated.says(one.text), generated.texts);
  }
}

TEST_CASE("gen: a PDO without mapping parameter, or with COB-ID 0, is switched off") {
  const std::string communication = record("1802") + sub("1802sub0", 5, "ro", "2") +
                                    sub("1802sub1", 7, "rw", "$NODEID+0x180") + sub("1802sub2", 5, "rw", "255");
  CHECK(generate(communication).says("1A02h (its mapping) is missing"));
  const Generated zero = generate(pdo('T', "0", "1", {"0x20000010"}) + objects);
  CHECK(zero.says("1802h sub 1 has no CAN-ID"));
  CHECK(configuration_of(zero).find("{0x80000000u},  // od_1802_1") != std::string::npos);
}

TEST_CASE("gen: an event-driven TPDO that neither flag A nor a timer transmits is noted") {
  const auto is_noted = [](const std::string& eds, gen::Options options = {}) {
    return generate(eds, std::move(options)).notes.find("gen-pdo-trigger\n") != std::string::npos;
  };
  const std::string tpdo = pdo('T', "$NODEID+0x180", "1", {"0x20000010"});
  CHECK(is_noted(tpdo + objects));
  CHECK(generate(tpdo + objects).says("TPDO 3 is event-driven without event timer, and maps no object with flag A"));
  CHECK(is_noted(tpdo + sub("1802sub5", 6, "rw", "0") + objects));
  CHECK_FALSE(is_noted(tpdo + sub("1802sub5", 6, "rw", "100") + objects));
  CHECK_FALSE(is_noted(pdo('R', "$NODEID+0x200", "1", {"0x20000010"}) + objects));
  CHECK_FALSE(is_noted(pdo('T', "0x80000180", "1", {"0x20000010"}) + objects));
  const Generated triggers = generate(tpdo + variable("2000", 6, "rw", "PDOMapping=1\n;TPDODetectCos=1"));
  CHECK(triggers.notes.find("gen-pdo-trigger") == std::string::npos);
  CHECK(triggers.has("CO_OBJ___APRW, CO_TUNSIGNED16, (CO_DATA)(&small_ram.od_2000_0)"));
  CHECK(is_noted(tpdo + variable("2000", 6, "rw", "PDOMapping=1\n;TPDODetectCos=0")));
  gen::Options options;
  options.trigger_tpdos = true;
  CHECK_FALSE(is_noted(tpdo + objects, options));
}

TEST_CASE("gen: the generated description has the PDO switched off") {
  const Generated generated = generate(pdo('T', "$NODEID+0x180", "0", {}) + objects);
  const Object* const communication = generated.output.device.find(0x1802);
  REQUIRE(communication != nullptr);
  CHECK(communication->find(1)->default_value.text == "$NODEID+0x80000180");
}

TEST_CASE("gen: a PDO that is switched off compiles with constant COB-IDs, limits and any mapping") {
  const std::string constant = record("1802") + sub("1802sub0", 5, "ro", "2") +
                               sub("1802sub1", 7, "const", "0x1FF\nLowLimit=1\nHighLimit=0x7FF") +
                               sub("1802sub2", 5, "const", "255");
  CHECK(generate(constant).has("(CO_DATA)(0x800001FFu)},"));
  const std::string limited =
      record("1802") + sub("1802sub0", 5, "ro", "2") + sub("1802sub1", 7, "rw", "0x1FF\nLowLimit=1\nHighLimit=0x7FF");
  CHECK_FALSE(generate(limited).has("0x800001FFu <= "));
  CHECK(is_off(generate(pdo('T', "0x1FF", "64", {"0xFFFFFF20", "0xFFFFFF00"}) + objects)));
  CHECK(is_off(generate(pdo('T', "0x1FF", "253", {}) + objects)));
  CHECK(generate(pdo('T', "0x1FF", "1", {"text"}) + objects).output.files.empty());
  CHECK(is_off(generate(pdo('T', "0x1FF", "1", {"-1"}) + objects)) == false);
}
