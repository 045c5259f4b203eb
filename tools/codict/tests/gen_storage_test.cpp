// SPDX-License-Identifier: Apache-2.0
// Assignment of sub-indexes of 1010h (store) and 1011h (restore) to storage groups.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "eds/read.hpp"
#include "eds/write.hpp"
#include "generating.hpp"
#include "reading.hpp"
#include "xdd/write.hpp"
#include "xdd_reading.hpp"

using namespace lexican::codict;

using test::generate;
using test::Generated;
using test::record;
using test::sub;
using test::variable;

namespace {

using Names = std::vector<std::pair<int, std::string>>;  // sub-index and name

// Returns 1010h or 1011h with sub-index 1 and the given ones.
std::string stores(const char* index, const Names& names) {
  std::string eds = record(index) + sub(fmt::format("{}sub0", index).c_str(), 5, "ro", "127") +
                    sub(fmt::format("{}sub1", index).c_str(), 7, "rw", "1");
  for (const auto& [number, name] : names) {
    eds +=
        fmt::format("[{}sub{:X}]\nParameterName={}\nDataType=7\nAccessType=rw\nDefaultValue=1\n", index, number, name);
  }
  return eds;
}

std::string stored(const char* index, const std::string& group) {
  return variable(index, 5, "rw", fmt::format(";StorageLocation={}\n", group).c_str());
}

// Returns true if an entry of 1010h or 1011h refers to the CO_PARA of a group.
bool is_stored_by(const Generated& generated, const char* entry, const char* type, const char* group) {
  return generated.has(fmt::format("{{SMALL_{} | CO_OBJ_____RW, {}, (CO_DATA)(&small_{}_para)}},", entry, type, group));
}

bool saves(const Generated& generated, const char* entry, const char* group) {
  return is_stored_by(generated, entry, "CO_TPARA_STORE", group);
}

bool restores(const Generated& generated, const char* entry, const char* group) {
  return is_stored_by(generated, entry, "CO_TPARA_RESTORE", group);
}

const Names standard_names = {{2, "Save communication parameters"},
                              {3, "Save application parameters"},
                              {4, "Save manufacturer defined parameters"}};

gen::Options small_options() {
  gen::Options options;
  options.name = "small";
  options.source = "small.eds";
  return options;
}

// Checks that a device has the dictionary of an EDS.
void check_equal(const Generated& eds, const Device& device) {
  Findings findings;
  const gen::Output output = gen::generate(device, small_options(), findings);
  REQUIRE(output.files.size() == eds.output.files.size());
  CHECK(output.files.at(0).bytes == eds.header());
  CHECK(output.files.at(1).bytes == eds.source());
}

Names with(Names names, int number, const char* name) {
  names.emplace_back(number, name);
  return names;
}

}  // namespace

TEST_CASE("gen: a storage group that a sub-index of 1010h names is stored by that sub-index") {
  const std::string store = stores("1010", with(standard_names, 5, "Save PERSIST_APP"));
  const Generated generated = generate(store + stored("1017", "PERSIST_COMM") + stored("2000", "PERSIST_APP"));
  CHECK(saves(generated, "1010_2", "persist_comm"));
  CHECK(saves(generated, "1010_5", "persist_app"));
  CHECK_FALSE(saves(generated, "1010_3", "persist_app"));
}

TEST_CASE("gen: names of storage groups are compared as whole words, in any case") {
  const Names names = {{2, "Save communication parameters"},
                       {3, "Save application parameters"},
                       {5, "save persist_app_auto, stored by itself"},
                       {6, "Save Persist Drive"},
                       {7, "SAVE PERSIST_MOTOR2"},
                       {8, "Save PERSIST_MOTOR"}};
  const Generated generated =
      generate(stores("1010", names) + stored("2000", "PERSIST_APP") + stored("2001", "PERSIST_APP_AUTO") +
               stored("2002", "PERSIST_DRIVE") + stored("2003", "Persist_Motor") + stored("2004", "persist_motor2"));
  CHECK(saves(generated, "1010_3", "persist_app"));
  CHECK(saves(generated, "1010_5", "persist_app_auto"));
  CHECK(saves(generated, "1010_6", "persist_drive"));
  CHECK(saves(generated, "1010_7", "persist_motor2"));
  CHECK(saves(generated, "1010_8", "persist_motor"));
}

TEST_CASE("gen: the storage groups of CANopenNode's example device are stored as its sub-objects are named") {
  const Names names = {{2, "Save communication parameters"},
                       {3, "Save application parameters"},
                       {4, "Save LSS parameters"},
                       {5, "Save testing parameters"},
                       {6, "Save testing auto-store parameters"}};
  const Generated generated =
      generate(stores("1010", names) + stored("1017", "PERSIST_COMM") + stored("2000", "PERSIST_TEST") +
               stored("2001", "PERSIST_TEST_AUTO") + stored("2002", "PERSIST_LSS"));
  CHECK(saves(generated, "1010_2", "persist_comm"));
  CHECK(saves(generated, "1010_4", "persist_lss"));
  CHECK(saves(generated, "1010_5", "persist_test"));
  CHECK(saves(generated, "1010_6", "persist_test_auto"));
}

TEST_CASE("gen: without such names 2 is communication, 3 application and 4 manufacturer") {
  const Names names = {{2, "Sub 2"}, {3, "Store parameters 3"}, {4, "Sub 4"}};
  const Generated generated = generate(stores("1010", names) + stored("1017", "PERSIST_COMM") +
                                       stored("2000", "PERSIST_APP") + stored("2001", "PERSIST_MFR"));
  CHECK(saves(generated, "1010_2", "persist_comm"));
  CHECK(saves(generated, "1010_3", "persist_app"));
  CHECK(saves(generated, "1010_4", "persist_mfr"));
  // A group that contains only objects of the communication profile is for communication, regardless of its name.
  CHECK(saves(generate(stores("1010", names) + stored("1017", "EEPROM")), "1010_2", "eeprom"));
  // A group with an unknown name is manufacturer-specific if there is one place for it.
  CHECK(saves(generate(stores("1010", names) + stored("2000", "DRIVE")), "1010_4", "drive"));
}

TEST_CASE("gen: a storage group that could be stored by several sub-indexes, or by none, is an error") {
  const auto found = [](const Names& names, const std::string& objects) {
    const Generated generated = generate(stores("1010", names) + objects);
    CHECK(generated.output.files.empty());
    return generated.found.find("gen-store\n") != std::string::npos;
  };
  // Sub-index 3 has another purpose in the description.
  CHECK(found({{2, "Save communication parameters"}, {3, "Save calibration"}}, stored("2000", "PERSIST_APP")));
  // No name distinguishes the two groups.
  CHECK(found({{2, "Sub 2"}, {4, "Sub 4"}, {5, "Sub 5"}}, stored("2000", "DRIVE") + stored("2001", "BRAKE")));
  // Two sub-indexes have the same name.
  CHECK(found({{4, "Save DRIVE"}, {5, "Save drive"}}, stored("2000", "DRIVE")));
}

TEST_CASE("gen: 1011h restores a group by the sub-index that names it, else by that of 1010h") {
  const std::string store = stores("1010", with(standard_names, 5, "Save PERSIST_APP"));
  const std::string objects = stored("1017", "PERSIST_COMM") + stored("2000", "PERSIST_APP");
  const Names same = with({{2, "Load 2"}, {3, "Load 3"}, {4, "Load 4"}}, 5, "Load 5");
  const Generated by_number = generate(store + stores("1011", same) + objects);
  CHECK(restores(by_number, "1011_2", "persist_comm"));
  CHECK(restores(by_number, "1011_5", "persist_app"));
  const Names others = with({{2, "Restore communication parameters"}, {3, "Load 3"}}, 4, "Restore PERSIST_APP");
  const Generated by_name = generate(store + stores("1011", others) + objects);
  CHECK(restores(by_name, "1011_2", "persist_comm"));
  CHECK(restores(by_name, "1011_4", "persist_app"));
  CHECK(saves(by_name, "1010_5", "persist_app"));
  const Generated missing = generate(store + stores("1011", {{2, "Restore communication parameters"}}) + objects);
  CHECK(missing.found.find("gen-restore\n") != std::string::npos);
}

TEST_CASE("gen: the group of an object is that of its sub-objects, unless these name another one than RAM") {
  const Generated eds = generate(test::fixture_text("gen/storage.eds"));
  CHECK(eds.found == "");
  CHECK(eds.has("(CO_DATA)(&small_persist_comm.od_1018_4)"));
  CHECK(eds.has("(CO_DATA)(&small_persist_app.od_2001_1)"));
  CHECK(eds.has("(CO_DATA)(&small_persist_comm.od_2001_2)"));
  CHECK_FALSE(eds.has("small_persist_app.od_2001_3"));
  CHECK(eds.has("(CO_DATA)(&small_ram.od_2002_1)"));
  CHECK(eds.has("(CO_DATA)(&small_persist_app.od_2002_2)"));
}

TEST_CASE("gen: EDS and XDD of CANopenEditor give the same storage groups") {
  const test::XmlReading xdd(test::fixture_text("gen/storage.xdd"));
  check_equal(generate(test::fixture_text("gen/storage.eds")), xdd.device);
}

TEST_CASE("gen: a description that is converted from EDS to XDD and back has the same dictionary") {
  for (const char* const fixture : {"gen/storage.eds", "gen/every_kind.eds", "storage_location.eds"}) {
    CAPTURE(fixture);
    const Generated eds = generate(test::fixture_text(fixture));
    const test::Reading reading(fixture);
    for (const xdd::Edition edition : {xdd::Edition::v10, xdd::Edition::v11}) {
      const test::XmlReading xdd(xdd::write(reading.device, edition));
      check_equal(eds, xdd.device);
      Findings findings;
      const eds::Document back(Source("device.eds", eds::write(xdd.device, {})), findings);
      check_equal(eds, eds::read(back, findings).devices.front());
    }
  }
}

TEST_CASE(
    "gen: CO_extensionIO=false gives an entry without default value a variable, also beside those of CANopenNode") {
  const auto generates = [](const std::string& property, const std::string& text) {
    const std::string group = "<property name=\"CO_storageGroup\" value=\"RAM\"/>";
    const test::XmlReading xdd(
        test::xdd_with("<CANopenObject index=\"2000\" name=\"a\" objectType=\"7\" dataType=\"05\" uniqueIDRef=\"P\"/>",
                       "<parameter uniqueID=\"P\" access=\"readWrite\"><label lang=\"en\">a</label><USINT/>" + group +
                           property + "</parameter>"));
    Findings findings;
    const gen::Output output = gen::generate(xdd.device, small_options(), findings);
    return !output.files.empty() && output.files[0].bytes.find(text) != std::string::npos;
  };
  CHECK(generates("", "extern uint8_t small_2000_0;"));
  CHECK(generates("<property name=\"CO_extensionIO\" value=\"\"/>", "extern uint8_t small_2000_0;"));
  CHECK(generates("<property name=\"CO_extensionIO\" value=\"false\"/>", "uint8_t od_2000_0;"));
}

TEST_CASE("gen: a sub-object of a stored object is kept in RAM if an XDD says so, also after a conversion to EDS") {
  // An EDS of CANopenEditor says RAM at each sub-object that names no group.
  CHECK(generate(test::fixture_text("gen/storage.eds")).has("(CO_DATA)(&small_persist_app.od_2001_1)"));
  std::string text = test::fixture_text("gen/storage.xdd");
  const std::size_t parameter = text.find("<q1:parameter uniqueID=\"UID_SUB_200101\"");
  REQUIRE(parameter != std::string::npos);
  text.insert(text.find("</q1:parameter>", parameter), "<q1:property name=\"CO_storageGroup\" value=\"RAM\"/>");
  const test::XmlReading xdd(text);
  Findings findings;
  const gen::Output output = gen::generate(xdd.device, small_options(), findings);
  REQUIRE(!output.files.empty());
  CHECK(output.files.at(1).bytes.find("(CO_DATA)(&small_ram.od_2001_1)") != std::string::npos);
  CHECK(output.files.at(1).bytes.find("(CO_DATA)(&small_persist_comm.od_2001_2)") != std::string::npos);
  const Generated back = generate(eds::write(xdd.device, {}));
  CHECK(back.header() == output.files.at(0).bytes);
  CHECK(back.source() == output.files.at(1).bytes);
}

TEST_CASE("gen: RAM, ROM and constants are not storage groups") {
  for (const char* group : {"RAM", "ROM", "rom", "const", "CONSTANT"}) {
    CAPTURE(group);
    const Generated generated =
        generate(stores("1010", standard_names) + stored("2000", group) + stored("2001", "PERSIST_APP"));
    CHECK(generated.has("(CO_DATA)(&small_ram.od_2000_0)"));
    CHECK(saves(generated, "1010_3", "persist_app"));
  }
  const Generated alone = generate(record("1010") + sub("1010sub0", 5, "ro", "1") + sub("1010sub1", 7, "rw", "1") +
                                   stored("2000", "ROM") + stored("2001", "EEPROM"));
  CHECK(alone.found == "");
  CHECK(saves(alone, "1010_1", "eeprom"));
}

TEST_CASE("gen: --store gives a storage group its sub-index, or leaves it in RAM") {
  const std::string store = stores("1010", {{2, "Sub 2"}, {4, "Sub 4"}, {5, "Sub 5"}});
  const std::string objects = stored("2000", "DRIVE") + stored("2001", "BRAKE");
  gen::Options options;
  options.store = {{"DRIVE", 5}, {"BRAKE", 4}};
  const Generated both = generate(store + objects, options);
  CHECK(saves(both, "1010_5", "drive"));
  CHECK(saves(both, "1010_4", "brake"));
  options.store = {{"DRIVE", 5}, {"BRAKE", 0}};
  const Generated one = generate(store + objects, options);
  CHECK(saves(one, "1010_5", "drive"));
  CHECK(one.has("(CO_DATA)(&small_ram.od_2001_0)"));
  options.store = {{"DRIVE", 6}, {"BRAKE", 4}};
  CHECK(generate(store + objects, options).says("--store DRIVE=6: sub-index 6 of 1010h is missing"));
  options.store = {{"DRIVE", 4}, {"BRAKE", 4}};
  CHECK(generate(store + objects, options).output.files.empty());
  for (const std::uint8_t sub_index : {std::uint8_t{0}, std::uint8_t{4}}) {
    options.store = {{"DRVE", sub_index}, {"DRIVE", 5}, {"BRAKE", 4}};
    CHECK(generate(store + objects, options).says("--store DRVE: no storage group DRVE; storage groups: DRIVE, BRAKE"));
  }
}

TEST_CASE("gen: the error of a storage group without sub-index lists the possible ones and the remedy") {
  const Names names = {{2, "Save communication parameters"}, {3, "Save calibration"}};
  const Generated generated = generate(stores("1010", names) + stored("2000", "PERSIST_APP"));
  CHECK(
      generated.says("storage group PERSIST_APP: no sub-index of 1010h is named for it; 1010h has 2 \"Save "
                     "communication parameters\", 3 \"Save calibration\""));
  CHECK(generated.says("--store PERSIST_APP=SUB"));
}

TEST_CASE("gen: names of sub-indices and storage groups may contain any characters") {
  const std::string junk(500, '_');
  for (const std::string& name :
       {std::string(), junk, std::string("\xFF\xFE="), std::string("PERSIST_"), std::string("=")}) {
    const Generated generated =
        generate(stores("1010", {{2, name}, {3, name}}) + stored("2000", name + "X") + stored("1017", "COM" + name));
    CHECK(!generated.found.empty());
  }
}
