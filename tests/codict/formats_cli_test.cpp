// SPDX-License-Identifier: Apache-2.0
// The commands of codict that go from one description to another, from outside.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "codict/program.hpp"
#include "codict/reading.hpp"

using test::bytes_of;
using test::Directory;
using test::has;
using test::Ran;
using test::run;
using Json = nlohmann::json;

TEST_CASE("codict convert: JSON has all that the other formats say, and becomes them again") {
  const Directory directory;
  const std::string json = directory / "device.json";
  const std::string again = directory / "again.xdc";
  const Ran ran = run("convert --strict-loss xdd/device10.xdd -o " + json);
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  CHECK(Json::parse(bytes_of(json)).at("schema") == "codict-device-1");
  CHECK(run("diff xdd/device10.xdd " + json).status == 0);
  CHECK(run("convert " + json + " -o " + again).status == 0);
  CHECK(run("diff xdd/device10.xdd " + again).status == 0);
  CHECK(run("convert " + json + " --to json -o -").out == bytes_of(json));
  CHECK(run("convert commissioning.dcf --to json -o - | '" LEXICAN_CODICT_PROGRAM
            "' convert - --to dcf -o - | '" LEXICAN_CODICT_PROGRAM "' diff - commissioning.dcf --only configuration")
            .status == 0);
}

TEST_CASE("codict convert: the JSON of an EDS becomes an EDS, which is not the same bytes") {
  const Directory directory;
  CHECK(run("convert drive.eds -o " + directory / "drive.json").status == 0);
  CHECK(run("convert " + directory / "drive.json" + " -o " + directory / "drive.eds").status == 0);
  CHECK(has(bytes_of(directory / "drive.eds"), "[FileInfo]\r\nFileName=drive.eds\r\n"));
  CHECK(run("diff drive.eds " + directory / "drive.eds").status == 0);
}

TEST_CASE("codict: JSON is read by all commands that read descriptions") {
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

TEST_CASE("codict: JSON that is no description is refused with one message that has line and column") {
  const Directory directory;
  const std::string path = directory / "other.json";
  test::write_bytes(path, "{\n  \"schema\": \"codict-check-1\"\n}\n");
  const Ran other = run("check " + path);
  CHECK(other.status == 2);
  CHECK(other.out.empty());
  CHECK(other.err ==
        "codict: " + path + ": line 2, column 14: another schema: \"schema\": \"codict-device-1\" is known\n");
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
  CHECK(has(ran.out, ":2:104: error: does not fit UNSIGNED8 [od-value-range]\n"));
  CHECK(has(ran.out, std::string(103, ' ') + "    ^~~\n"));
  CHECK_FALSE(has(run("check --disable json-type " + path).err, "there is no rule"));
}
