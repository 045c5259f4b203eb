// SPDX-License-Identifier: Apache-2.0
// Dictionaries generated from fixtures/gen/every_kind.eds, in C and in C++, accessed over the bus.
#include <doctest/doctest.h>

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clock/dictionary.hpp"
#include "every_c_od.h"
#include "every_cpp_od.h"
#include "gen_node.hpp"
#include "unmappable_c_od.h"
#include "unmappable_cpp_od.h"

namespace {

using test::GeneratedNode;
using test::Memory;

std::uint8_t picture[] = {1, 2, 3, 4};

}  // namespace

extern "C" {
CO_OBJ_DOM every_c_2300_0 = {0, sizeof picture, picture};
CO_OBJ_DOM every_cpp_2300_0 = {0, sizeof picture, picture};
}

namespace {

struct Dictionary {
  const char* language;
  const CO_OBJ* od;
  std::uint16_t length;
  void* stored;
  std::size_t stored_size;
};

const Dictionary dictionaries[] = {
    {"C", every_c_od, EVERY_C_OD_NUM, &every_c_persist_app, sizeof every_c_persist_app},
    {"C++", every_cpp_od, EVERY_CPP_OD_NUM, &every_cpp_persist_app, sizeof every_cpp_persist_app},
};

// Index and sub-index, and the bytes of an SDO upload with node-ID 5.
const std::map<std::uint32_t, std::string> values = {
    {0x100000, "91 01 0F 00"},
    {0x100100, "00"},
    {0x100300, "00"},
    {0x100301, "abort 08000024"},
    {0x100302, "abort 08000024"},
    {0x100500, "80 00 00 00"},
    {0x100600, "00 00 00 00"},
    {0x100700, "00 00 00 00"},
    {0x100800, "47 65 6E 65 72 61 74 65 64 20 22 6E 6F 64 65 22"},
    {0x100900, "41"},
    {0x101000, "03"},
    {0x101001, "01 00 00 00"},
    {0x101002, "01 00 00 00"},
    {0x101003, "01 00 00 00"},
    {0x101100, "03"},
    {0x101101, "01 00 00 00"},
    {0x101102, "01 00 00 00"},
    {0x101103, "01 00 00 00"},
    {0x101400, "85 00 00 00"},
    {0x101500, "00 00"},
    {0x101600, "02"},
    {0x101601, "64 00 03 00"},
    {0x101602, "00 00 00 00"},
    {0x101700, "00 00"},
    {0x101800, "04"},
    {0x101801, "00 00 00 00"},
    {0x101802, "34 12 00 00"},
    {0x101803, "02 00 01 00"},
    {0x101804, "07 00 00 00"},
    {0x101900, "00"},
    {0x102000, "02"},
    {0x102001, "00 00 00 00"},
    {0x102002, "00 00 00 00"},
    {0x102900, "01"},
    {0x102901, "00"},
    {0x120000, "02"},
    {0x120001, "05 06 00 00"},
    {0x120002, "85 05 00 00"},
    {0x128000, "03"},
    {0x128001, "00 00 00 80"},
    {0x128002, "00 00 00 80"},
    {0x128003, "01"},
    {0x140000, "05"},
    {0x140001, "05 02 00 00"},
    {0x140002, "FF"},
    {0x140005, "00 00"},
    {0x160000, "02"},
    {0x160001, "10 00 03 20"},
    {0x160002, "08 00 01 20"},
    {0x180000, "06"},
    {0x180001, "85 01 00 40"},
    {0x180002, "FF"},
    {0x180003, "00 00"},
    {0x180005, "00 00"},
    {0x180006, "00"},
    {0x1A0000, "02"},
    {0x1A0001, "08 00 05 20"},
    {0x1A0002, "18 00 16 20"},
    {0x200100, "01"},
    {0x200200, "FB"},
    {0x200300, "D4 FE"},
    {0x200400, "90 EE FE FF"},
    {0x200500, "C8"},
    {0x200600, "50 C3"},
    {0x200700, "EF BE AD DE"},
    {0x200800, "00 00 C0 3F"},
    {0x200900, "74 65 78 74"},
    {0x200A00, "01 02 FF"},
    {0x200B00, "41 00 E4 00"},
    {0x200C00, "00 00 00 00 00 00"},
    {0x200D00, "00 00 00 00 00 00"},
    {0x200F00, "00 11 22 33 44 55 66 77 88 99"},
    {0x201000, "90 EE FE"},
    {0x201100, "00 00 00 00 00 00 D0 BF"},
    {0x201200, "00 0E FA D5 FE"},
    {0x201300, "00 0E FA D5 FE FF"},
    {0x201400, "00 0E FA D5 FE FF FF"},
    {0x201500, "00 00 00 00 00 00 00 80"},
    {0x201600, "56 34 12"},
    {0x201800, "9A 78 56 34 12"},
    {0x201900, "BC 9A 78 56 34 12"},
    {0x201A00, "DE BC 9A 78 56 34 12"},
    {0x201B00, "F0 DE BC 9A 78 56 34 12"},
    {0x202000, "07 00"},
    {0x202100, "abort 06010001"},
    {0x202200, "00 00 50 40"},
    {0x202300, "00 00 00 80"},
    {0x202400, "05 01 00 00"},
    {0x202500, "01"},
    {0x202600, "CA FE"},
    {0x203000, "F4 01"},
    {0x203100, "00"},
    {0x203200, "00 00 00 00"},
    {0x203300, "00 00 00 00 00 00 00 00"},
    {0x203400, "00 00 00 00"},
    {0x203500, "00 00 00"},
    {0x203600, "03"},
    {0x210000, "01"},
    {0x210100, "34 12"},
    {0x210200, "FE FF FF FF FF FF FF FF"},
    {0x210300, "73 74 6F 72 65 64"},
    {0x210400, "AA BB CC"},
    {0x210500, "78 00 79 00 7A 00"},
    {0x210600, "01 02 03 04 05"},
    {0x210700, "00 00 00 00 00 00 04 40"},
    {0x220000, "03"},
    {0x220001, "01 00"},
    {0x220002, "02 00"},
    {0x220003, "03 00"},
    {0x230000, "01 02 03 04"},
};

const char* const save = "73 61 76 65";
const char* const load = "6C 6F 61 64";
const char* const too_high = "abort 06090031";
const char* const too_low = "abort 06090032";

}  // namespace

TEST_CASE("gen: every object of a generated dictionary returns its default value") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.fault == CO_DICT_OK);
    CHECK(node.error == CO_ERR_NONE);
    CHECK(dictionary.length == values.size() + 1);
    CHECK(dictionary.od[values.size()].Key == CO_DEFAULTS_KEY);
    for (std::size_t n = 0; n < values.size(); ++n) {
      const std::uint32_t key = dictionary.od[n].Key;
      CAPTURE(CO_GET_IDX(key));
      CAPTURE(CO_GET_SUB(key));
      CHECK(node.read(CO_GET_IDX(key), CO_GET_SUB(key)) == values.at(key >> 8));
    }
  }
}

TEST_CASE("gen: a value outside of its limits is refused with 0609 0031h or 0032h and changes nothing") {
  struct Limit {
    std::uint16_t index;
    const char* lowest;
    const char* below;  // null: there is no lower value
    const char* highest;
    const char* above;
  };
  const Limit limits[] = {
      {0x2030, "64 00", "63 00", "E8 03", "E9 03"},
      {0x2031, "F6", "F5", "0A", "0B"},
      {0x2032, "00 00 C0 BF", "01 00 C0 BF", "00 00 20 40", "01 00 20 40"},
      {0x2033, "00 0E FA D5 FE FF FF FF", "FF 0D FA D5 FE FF FF FF", "00 F2 05 2A 01 00 00 00",
       "01 F2 05 2A 01 00 00 00"},
      {0x2034, "00 00 00 00", nullptr, "00 00 00 80", "01 00 00 80"},
      {0x2035, "60 79 FE", "5F 79 FE", "A0 86 01", "A1 86 01"},
      {0x2036, "02", "01", "FF", nullptr},
      {0x1017, "00 00", nullptr, "10 27", "11 27"},
      {0x2101, "00 00", nullptr, "00 20", "01 20"},
  };
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    for (const Limit& limit : limits) {
      CAPTURE(limit.index);
      CHECK(node.write(limit.index, 0, limit.lowest) == "ok");
      if (limit.below != nullptr) {
        CHECK(node.write(limit.index, 0, limit.below) == too_low);
      }
      CHECK(node.read(limit.index, 0) == limit.lowest);
      CHECK(node.write(limit.index, 0, limit.highest) == "ok");
      if (limit.above != nullptr) {
        CHECK(node.write(limit.index, 0, limit.above) == too_high);
      }
      CHECK(node.read(limit.index, 0) == limit.highest);
    }
    CHECK(node.write(0x2032, 0, "00 00 C0 7F") == too_high);  // NaN
    CHECK(node.write(0x2032, 0, "00 00 00 80") == "ok");      // -0
    CHECK(node.write(0x2030, 0, "64 00 00 00") == "abort 06070012");
    CHECK(node.write(0x2030, 0, "F4 01") == "ok");
  }
}

TEST_CASE("gen: a PDO does not write values outside of the limits") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.write(0x1400, 1, "05 02 00 80") == "ok");
    CHECK(node.write(0x1600, 0, "00") == "ok");
    CHECK(node.write(0x1600, 1, "10 00 30 20") == "ok");
    CHECK(node.write(0x1600, 0, "01") == "ok");
    CHECK(node.write(0x1400, 1, "05 02 00 00") == "ok");
    node.say(0, "01 05");  // operational
    node.say(0x205, "2C 01");
    CHECK(node.read(0x2030, 0) == "2C 01");
    node.say(0x205, "E9 03");
    CHECK(node.read(0x2030, 0) == "2C 01");
    node.say(0x205, "F4 01");
    CHECK(node.read(0x2030, 0) == "F4 01");
  }
}

TEST_CASE("gen: a storage group keeps its values over power loss and can be restored to its defaults") {
  const std::map<std::uint16_t, std::string> changed = {
      {0x2100, "09"}, {0x2101, "01 00"},       {0x2102, "01 02 03 04 05 06 07 08"}, {0x2103, "61 62"},
      {0x2104, "10"}, {0x2105, "31 00 32 00"}, {0x2106, "05 04 03 02 01"},          {0x2107, "00 00 00 00 00 00 F0 3F"},
  };
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    {
      GeneratedNode node(dictionary.od, dictionary.length, memory);
      for (const auto& [index, bytes] : changed) {
        CHECK(node.write(index, 0, bytes) == "ok");
      }
      CHECK(node.write(0x1016, 2, "E8 03 07 00") == "ok");
      CHECK(node.write(0x1010, 3, save) == "ok");
      CHECK(node.write(0x1010, 2, save) == "ok");
    }
    std::memset(dictionary.stored, 0x55, dictionary.stored_size);
    {
      GeneratedNode node(dictionary.od, dictionary.length, memory);
      CHECK(node.error == CO_ERR_NONE);
      for (const auto& row : changed) {
        const auto& [index, bytes] = row;
        CAPTURE(row.first);
        CHECK(node.read(index, 0) == bytes);
      }
      CHECK(node.read(0x1016, 2) == "E8 03 07 00");
      CHECK(node.read(0x1016, 1) == "64 00 03 00");
      CHECK(node.write(0x1011, 1, load) == "ok");
    }
    std::memset(dictionary.stored, 0x55, dictionary.stored_size);
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    for (const auto& row : changed) {
      const auto& [index, bytes] = row;
      CAPTURE(row.first);
      CHECK(node.read(index, 0) == values.at(std::uint32_t{index} << 8));
    }
    CHECK(node.read(0x1016, 2) == "00 00 00 00");
  }
}

TEST_CASE("gen: any write to a storage group sets 1020h to 0 [301:7.5.2.23]") {
  const std::map<std::uint32_t, std::string> changed = {
      {0x101602, "E8 03 07 00"}, {0x210000, "09"}, {0x210300, "61 62"}, {0x210500, "31 00"}, {0x210600, "05"}};
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    for (const auto& row : changed) {
      const auto& [key, bytes] = row;
      CAPTURE(row.first);
      for (std::uint8_t sub = 1; sub <= 2; ++sub) {
        CHECK(node.write(0x1020, sub, "01 02 03 04") == "ok");
      }
      CHECK(node.write(static_cast<std::uint16_t>(key >> 8), static_cast<std::uint8_t>(key), bytes) == "ok");
      for (std::uint8_t sub = 1; sub <= 2; ++sub) {
        CHECK(node.read(0x1020, sub) == "00 00 00 00");
      }
    }
  }
}

const char* const reset_node = "81 05";
const char* const reset_communication = "82 05";

TEST_CASE("gen: reset communication sets 1017h and the heartbeat period to their defaults [301:7.3.2.2]") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.write(0x1017, 0, "FA 00") == "ok");
    CHECK(node.read(0x1017, 0) == "FA 00");
    node.say(0, reset_communication);
    CHECK(node.read(0x1017, 0) == "00 00");
  }
}

TEST_CASE("gen: resets set every entry that was written by SDO to its default value [301:7.3.2.2]") {
  // The COB-IDs disable the PDOs, so that their mapping may change.
  const std::vector<std::pair<std::uint32_t, std::string>> of_communication = {
      {0x100500, "81 00 00 00"}, {0x100600, "10 27 00 00"}, {0x100700, "E8 03 00 00"}, {0x101400, "85 00 00 80"},
      {0x101500, "01 00"},       {0x101602, "E8 03 07 00"}, {0x101700, "E8 03"},       {0x102001, "01 00 00 00"},
      {0x102901, "01"},          {0x140001, "05 02 00 80"}, {0x140002, "01"},          {0x160000, "00"},
      {0x180005, "0A 00"},
  };
  const std::vector<std::pair<std::uint32_t, std::string>> of_application = {
      {0x200100, "00"},
      {0x200300, "01 00"},
      {0x200800, "00 00 80 3F"},
      {0x200900, "6C 6F 6E 67 65 72"},
      {0x200A00, "07"},
      {0x200B00, "42 00"},
      {0x200C00, "01 00 00 00 01 00"},
      {0x200F00, "09 08 07 06"},
      {0x201B00, "01 00 00 00 00 00 00 00"},
      {0x202400, "06 01 00 00"},
      {0x203000, "65 00"},
      {0x203300, "01 00 00 00 00 00 00 00"},
      {0x210000, "09"},
      {0x210300, "61 62"},
      {0x210600, "05 04 03 02 01"},
  };
  const auto index_of = [](std::uint32_t key) { return static_cast<std::uint16_t>(key >> 8); };
  const auto sub_of = [](std::uint32_t key) { return static_cast<std::uint8_t>(key); };
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    const auto write_all = [&](const auto& objects) {
      for (const auto& row : objects) {
        const auto& [key, bytes] = row;
        CAPTURE(row.first);
        CHECK(node.write(index_of(key), sub_of(key), bytes) == "ok");
      }
    };
    const auto check_defaults = [&](const auto& objects) {
      for (const auto& row : objects) {
        const auto& [key, bytes] = row;
        CAPTURE(row.first);
        CHECK(node.read(index_of(key), sub_of(key)) == values.at(key));
      }
    };
    write_all(of_application);
    write_all(of_communication);
    node.say(0, reset_communication);
    check_defaults(of_communication);
    for (const auto& row : of_application) {
      const auto& [key, bytes] = row;
      CAPTURE(row.first);
      CHECK(node.read(index_of(key), sub_of(key)) == (key == 0x200F00 ? bytes + " 44 55 66 77 88 99" : bytes));
    }
    write_all(of_communication);
    node.say(0, reset_node);
    check_defaults(of_communication);
    check_defaults(of_application);
    CHECK(node.read(0x1020, 1) == values.at(0x102001));
  }
}

TEST_CASE("gen: reset communication loads the stored communication objects") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.write(0x1017, 0, "FA 00") == "ok");
    CHECK(node.write(0x1010, 2, save) == "ok");
    CHECK(node.write(0x1017, 0, "07 00") == "ok");
    node.say(0, reset_communication);
    CHECK(node.read(0x1017, 0) == "FA 00");
    CHECK(node.write(0x1011, 2, load) == "ok");
    node.say(0, reset_communication);
    CHECK(node.read(0x1017, 0) == "00 00");
  }
}

TEST_CASE("gen: a PDO that was mapped anew by SDO has its default mapping after reset communication") {
  for (const Dictionary& dictionary : dictionaries) {
    CAPTURE(dictionary.language);
    Memory memory;
    GeneratedNode node(dictionary.od, dictionary.length, memory);
    CHECK(node.write(0x1400, 1, "05 02 00 80") == "ok");
    CHECK(node.write(0x1600, 0, "00") == "ok");
    CHECK(node.write(0x1600, 1, "10 00 30 20") == "ok");
    CHECK(node.write(0x1600, 0, "01") == "ok");
    CHECK(node.write(0x1400, 1, "05 03 00 00") == "ok");
    node.say(0, "01 05");
    node.say(0x305, "2C 01");
    CHECK(node.read(0x2030, 0) == "2C 01");
    node.say(0, reset_communication);
    node.say(0, "01 05");
    node.say(0x305, "2D 01");
    CHECK(node.read(0x2030, 0) == "2C 01");
    CHECK(node.read(0x1400, 1) == values.at(0x140001));
    CHECK(node.read(0x1600, 0) == values.at(0x160000));
    CHECK(node.read(0x1600, 1) == values.at(0x160001));
  }
}

TEST_CASE("gen: resets do not change variables that SDO can only read") {
  Memory memory;
  every_c_set_defaults();
  CHECK(every_c_ram.read_only == 7);
  CHECK(every_c_ram.od_2030_0 == 500);
  every_c_ram.read_only = 8;
  every_c_ram.od_2030_0 = 501;
  GeneratedNode node(every_c_od, EVERY_C_OD_NUM, memory);
  CHECK(node.read(0x2020, 0) == "08 00");
  CHECK(node.read(0x2030, 0) == "F4 01");
  node.say(0, reset_node);
  CHECK(node.read(0x2020, 0) == "08 00");
  every_c_set_defaults();
  CHECK(every_c_ram.read_only == 7);
}

TEST_CASE("gen: the demo clock: 1017h written as 250 and not stored is 1000 after reset communication") {
  Memory memory;
  clock_set_defaults();
  GeneratedNode node(clock_od, CLOCK_OD_NUM, memory);
  CHECK(node.write(0x1017, 0, "FA 00") == "ok");
  CHECK(node.write(0x1020, 1, "05 00 00 00") == "ok");
  CHECK(node.write(0x2101, 0, "3C 00") == "ok");
  CHECK(node.write(0x2201, 0, "61 62") == "ok");
  CHECK(node.write(0x2100, 2, "0A") == "ok");
  node.say(0, reset_communication);
  CHECK(node.read(0x1017, 0) == "E8 03");
  CHECK(node.read(0x1020, 1) == "00 00 00 00");
  CHECK(node.read(0x2101, 0) == "3C 00");
  CHECK(node.read(0x2201, 0) == "61 62");
  CHECK(node.read(0x2100, 2) == "0A");
  node.say(0, reset_node);
  CHECK(node.read(0x2101, 0) == "00 00");
  CHECK(node.read(0x2201, 0) == "");
  CHECK(node.read(0x2100, 2) == "00");
}

TEST_CASE("gen: a constant mapping of an object with PDOMapping=0 works; SDO cannot map the object") {
  struct Unmappable {
    const CO_OBJ* od;
    std::uint16_t length;
  };
  for (const Unmappable& device :
       {Unmappable{unmappable_c_od, UNMAPPABLE_C_OD_NUM}, Unmappable{unmappable_cpp_od, UNMAPPABLE_CPP_OD_NUM}}) {
    Memory memory;
    GeneratedNode node(device.od, device.length, memory);
    CHECK(node.fault == CO_DICT_OK);
    CHECK(node.error == CO_ERR_NONE);
    node.say(0, "01 05");  // operational
    node.say(0x205, "11 22");
    CHECK(node.read(0x2000, 0) == "11 22");
    node.say(0x305, "33 44");
    CHECK(node.read(0x2001, 0) == "33 44");
    CHECK(node.sent_by([&] { COTPdoTrigPdo(node.node.TPdo, 0); }) == "185: 01 02");
    CHECK(node.sent_by([&] { COTPdoTrigPdo(node.node.TPdo, 1); }) == "285: 03 04");
    // Mappings by the network require PDOMapping=1 in the description.
    CHECK(node.write(0x1401, 1, "05 03 00 80") == "ok");
    CHECK(node.write(0x1601, 0, "00") == "ok");
    CHECK(node.write(0x1601, 1, "10 00 04 20") == "abort 06040041");
    CHECK(node.write(0x1601, 1, "10 00 01 20") == "abort 06040041");
    // Reset communication restores the mapping of the description.
    node.say(0, reset_communication);
    node.say(0, "01 05");
    node.say(0x305, "55 66");
    CHECK(node.read(0x2001, 0) == "55 66");
  }
}

TEST_CASE("gen: variables have the names of the description, and entries are typed values in C++") {
  Memory memory;
  GeneratedNode node(every_cpp_od, EVERY_CPP_OD_NUM, memory);
  CHECK(EVERY_CPP_LIMITED_UNSIGNED == CO_DEV(0x2030, 0));
  every_cpp_ram.read_only = 0x0102;
  CHECK(node.read(0x2020, 0) == "02 01");
  CHECK(every_cpp_objects::read_only(node.node).get().value() == 0x0102);
  CHECK(every_cpp_objects::od_2012_0(node.node).get().value() == -5000000000);
  every_cpp_ram.od_2020_0 = 7;
}
