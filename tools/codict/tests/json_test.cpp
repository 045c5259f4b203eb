// SPDX-License-Identifier: Apache-2.0
// Descriptions as JSON, schema codict-device-1.
#include "json/read.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "diff/diff.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "eds/write.hpp"
#include "files.hpp"
#include "json/write.hpp"
#include "program.hpp"
#include "reading.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"
#include "xdd/write.hpp"
#include "xdd_dump.hpp"

using namespace lexican::codict;
using test::has;

namespace {

struct JsonReading {
  explicit JsonReading(const std::string& bytes, const std::string& name = "device.json")
      : document(Source(name, bytes)), refusal(json::refusal(document)) {
    if (refusal.empty()) {
      description = json::read(document, findings);
    }
  }

  // Returns "line:column rule" of each finding, one per line.
  std::string found() const {
    std::string text;
    for (const Finding& finding : findings.all()) {
      const Position position = document.source().position(finding.span.begin);
      text += fmt::format("{}:{} {}\n", position.line, position.column, finding.rule->id);
    }
    return text;
  }
  bool has(const char* rule) const { return test::has(found(), std::string(" ") + rule + "\n"); }
  const Device& device() const { return description.devices.at(0); }

  Findings findings;
  json::Document document;
  std::string refusal;
  Description description;
};

// Returns a device with one object that has these members.
std::string with(const std::string& members) {
  return R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [
{"index": 8192, )" +
         members + "}\n]}]}";
}

const Value& value_of(const JsonReading& reading) { return reading.device().objects.at(0).default_value; }

// Reads a description; returns nothing if the reader refuses it.
template <typename Document, typename Refuse, typename Read>
std::optional<Description> description_of(const std::string& path, Refuse refusal, Read read) {
  Findings findings;
  Document document(Source(path, test::bytes_of(path)), findings);
  return refusal(document).empty() ? std::optional(read(document, findings)) : std::nullopt;
}

std::optional<Description> description_of(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  if (ending == ".eds" || ending == ".dcf") {
    return description_of<eds::Document>(
        path, [](const auto& what) { return eds::refusal(what); }, eds::read);
  }
  if (!xdd::refusal(Source(path, test::bytes_of(path))).empty()) {
    return std::nullopt;
  }
  return description_of<xdd::Document>(
      path, [](const auto& what) { return xdd::refusal(what); }, xdd::read);
}

void check_device(const Device& before, const Device& after) {
  CHECK(diff::compare(before, after).empty());
  CHECK(dump(after) == dump(before));
  eds::WriteOptions options;
  options.as_dcf = true;
  CHECK(eds::write(after, options) == eds::write(before, options));
  CHECK(xdd::write(after, xdd::Edition::v11) == xdd::write(before, xdd::Edition::v11));
}

std::size_t check_round_trips(const std::string& directory) {
  std::size_t number = 0;
  for (const std::string& path : test::files_in(directory, test::all_endings())) {
    CAPTURE(path);
    const std::optional<Description> before = description_of(path);
    if (!before) {
      continue;
    }
    const std::string written = json::write(*before);
    const JsonReading after(written, path);
    REQUIRE(after.refusal.empty());
    CHECK_FALSE(has(after.found(), " json-"));
    CHECK(json::write(after.description) == written);
    REQUIRE(after.description.devices.size() == before->devices.size());
    for (std::size_t n = 0; n < before->devices.size(); ++n) {
      check_device(before->devices[n], after.description.devices[n]);
    }
    ++number;
  }
  return number;
}

}  // namespace

TEST_CASE("JSON: each fixture that is written and read again is the same device") {
  CHECK(check_round_trips(test::fixture("")) > 60);
}

TEST_CASE("JSON: each description of the corpus that is written and read again is the same device" *
          doctest::test_suite(test::needs_corpus) * test::skipped_without_corpus()) {
  CHECK(check_round_trips(test::corpus()) > 0);
}

TEST_CASE("JSON: invalid JSON is refused with its line and column") {
  const auto refusal = [](const std::string& bytes) { return JsonReading(bytes).refusal; };
  CHECK(has(refusal("{\n  \"schema\": codict\n}"), "line 2, column 13: this is no JSON"));
  CHECK(has(refusal("{"), "line 1, column 2: this is no JSON"));
  CHECK(has(refusal("{\"a\": 1e999}"), "this is no JSON"));
  CHECK(has(refusal("{\"a\": \"\xff\"}"), "line 1, column 8: this is no JSON"));
  CHECK(has(refusal("{} {}"), "line 1, column 4: this is no JSON"));
  CHECK_FALSE(has(refusal("{\n  \"schema\": codict\n}"), "\n"));
}

TEST_CASE("JSON: another kind of JSON is refused with its name") {
  const auto refusal = [](const std::string& bytes) { return JsonReading(bytes).refusal; };
  CHECK(has(refusal(R"({"fileInfo": {}, "deviceInfo": {}, "objects": {}})"), "a project of CANopenEditor in JSON"));
  CHECK(has(refusal(R"({"$schema": "x", "version": "2.1.0", "runs": []})"), "a SARIF log"));
  CHECK(has(refusal(R"({"$schema": "x", "properties": {}})"), "a JSON Schema"));
  CHECK(has(refusal(R"({"a": 1, "b": 2, "c": 3, "d": 4, "e": 5})"), "JSON with the members a, b, c, d, …: "));
  CHECK(has(refusal("[{\"index\": 1}]"), "a JSON array"));
  for (const char* json : {"{", "[{}]", " [ [1] ]", "[\"a\"]"}) {
    CHECK(json::is_json(Source("a.json", json)));
  }
  for (const char* eds : {"", "[", "[FileInfo]", "[1000]", "[1000, 1]", "; {\n[FileInfo]"}) {
    CHECK_FALSE(json::is_json(Source("a.eds", eds)));
  }
}

TEST_CASE("JSON: another schema and a description of no device are refused") {
  const auto refusal = [](const std::string& bytes) { return JsonReading(bytes).refusal; };
  const std::string wanted = "no device description, which has \"schema\": \"codict-device-1\"";
  CHECK(refusal("{}") == "line 1, column 1: this is an empty JSON object: " + wanted);
  CHECK(has(refusal("{\"schema\": 1}"), "this is JSON with the members schema: " + wanted));
  CHECK(refusal("{\n\"schema\": \"codict-device-2\"}") ==
        "line 2, column 12: version 2 of the schema: this codict reads \"schema\": \"codict-device-1\"");
  CHECK(refusal("{\"schema\": \"codict-check-1\"}") ==
        "line 1, column 13: codict-check-1 is the output of a command, " + wanted);
  CHECK(has(refusal("{\"schema\": \"other\"}"), "another schema, other: " + wanted));
  CHECK(has(refusal(R"({"schema": "codict-device-1"})"), "there are no devices"));
  CHECK(has(refusal(R"({"schema": "codict-device-1", "devices": []})"), "there are no devices"));
  CHECK(has(refusal(R"({"schema": "codict-device-1", "devices": 1})"), "there are no devices"));
}

TEST_CASE("JSON: too deep nesting and too many values are refused") {
  const std::string deep(1000000, '[');
  CHECK(has(JsonReading("{\"a\":" + deep).refusal, "more than 200 levels"));
  std::string many = "{\"a\":[0";
  for (int n = 0; n < 1000000; ++n) {
    many += ",0";
  }
  CHECK(has(JsonReading(many + "]}").refusal, "more than 1000000 values"));
}

TEST_CASE("JSON: a member of a wrong type is a finding at its place and ignored") {
  const JsonReading reading(with(R"("name": 5,
"object_code": "var", "data_type": "x",
"access": "often",
"flags": -1,
"subs": {},
"links": [65536],
"words": {"labels": [1]})"));
  REQUIRE(reading.refusal.empty());
  CHECK(reading.found() ==
        "2:25 json-type\n3:37 json-type\n4:12 json-word\n5:10 json-range\n6:9 json-type\n7:11 json-range\n"
        "8:22 json-type\n");
  CHECK_FALSE(reading.device().objects.at(0).name.is_given);
  CHECK(reading.device().objects.at(0).access.value == Access::unknown);
}

TEST_CASE("JSON: wrong types at any place are findings only") {
  Findings findings;
  const eds::Document document(Source("drive.eds", test::bytes_of(test::fixture("gen/every_kind.eds"))), findings);
  const std::string whole = json::write(eds::read(document, findings));
  for (const std::string wrong : {"null", "true", "-1", "1.5", "\"\"", "[]", "{}", "[[{}]]"}) {
    std::string bytes = whole;
    for (std::size_t at = whole.rfind("\": "); at > 300; at = whole.rfind("\": ", at - 1)) {
      const std::size_t end = whole.find_first_of(",}\n", at);
      const bool is_scalar = whole[at + 3] != '{' && whole[at + 3] != '[';
      if (is_scalar && whole.substr(at + 3, end - at - 3).find('\\') == std::string::npos && at % 7 == 0) {
        bytes.replace(at + 3, end - at - 3, wrong);
      }
    }
    const JsonReading reading(bytes);
    CHECK((!reading.refusal.empty() || !reading.findings.all().empty()));
  }
}

TEST_CASE("JSON: an unknown or duplicate member is reported") {
  const JsonReading reading(with(R"("nme": "x", "name": "a", "name": "b")") + "\n");
  CHECK(reading.found() == "2:18 json-unknown\n2:43 json-duplicate\n");
  CHECK(reading.device().objects.at(0).name.text == "a");
  CHECK(JsonReading(R"({"schema": "codict-device-1", "devices": [{}]})").found() == "1:43 json-missing\n");
}

TEST_CASE("JSON: objects are sorted, and a duplicate index is reported") {
  const JsonReading reading(R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [
{"index": 8193, "name": "b", "subs": [{"sub_index": 2}, {"sub_index": 1}]},
{"index": 8192, "name": "a"},
{"index": 8193, "name": "c"}]}]})");
  CHECK(reading.found() == "4:1 json-duplicate\n");
  REQUIRE(reading.device().objects.size() == 2);
  CHECK(reading.device().find(0x2001)->name.text == "b");
  CHECK(reading.device().find(0x2001)->find(1) != nullptr);
}

TEST_CASE("JSON: an object or sub-object whose number does not fit is sorted as number 0, which it gets") {
  const JsonReading reading(R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [
{"index": 8192, "subs": [{"sub_index": 1}, {"sub_index": 256}]},
{"index": 70000},
{"index": -1}]}]})");
  CHECK(reading.found() == "2:58 json-range\n3:11 json-range\n4:1 json-duplicate\n");
  REQUIRE(reading.device().objects.size() == 2);
  CHECK(reading.device().objects[0].index == 0);
  CHECK(reading.device().find(0x2000)->subs.at(0).sub_index == 0);
}

TEST_CASE("JSON: a value without text gets one, and a text without value is parsed") {
  const JsonReading values(with(R"("object_code": "var", "data_type": 6, "access": "rw", "default_value": 500)"));
  CHECK(values.found().empty());
  const Object& object = values.device().objects.at(0);
  CHECK(object.data_type.text == "6");
  CHECK(object.access.is_given);
  CHECK(object.access.text == "rw");
  CHECK(object.default_value.text == "500");
  const JsonReading texts(with(R"("data_type": {"text": "0x7"}, "default_value": "$NODEID+0x180")"));
  CHECK(texts.found().empty());
  CHECK(texts.device().objects.at(0).data_type.value == 7);
  CHECK(test::meaning(value_of(texts)) == "$NODEID+384");
  const JsonReading wrong(with(R"("data_type": 5, "default_value": "256")"));
  CHECK(wrong.found() == "2:51 od-value-range\n");
  CHECK(test::meaning(value_of(JsonReading(with(R"("default_value": {"value": 384, "node_id": true})")))) ==
        "$NODEID+384");
  CHECK(value_of(JsonReading(with(R"("default_value": {"value": 384, "node_id": true})"))).text == "$NODEID+0x180");
  CHECK(test::meaning(value_of(JsonReading(with(R"("default_value": {"kind": "octets", "value": "01fF"})")))) ==
        "octets 01 FF");
  CHECK(test::meaning(value_of(JsonReading(with(R"("default_value": -1.5)")))) == "-1.5");
}

TEST_CASE("JSON: RAM at a sub-object is a storage group, unless it comes from an EDS") {
  const auto group_of = [](const JsonReading& reading) {
    return reading.device().find(0x2001)->find(1)->node->storage_group.value;
  };
  const auto with_group = [](const std::string& group) {
    return R"({"schema": "codict-device-1", "devices": [{"format": "eds", "objects": [{"index": 8193, "subs": [
{"sub_index": 1, "node": {"storage_group": )" +
           group + "}}]}]}]}";
  };
  CHECK(group_of(JsonReading(with_group("\"RAM\""))) == "RAM");
  CHECK(group_of(JsonReading(with_group("{\"text\": \"RAM\"}"))) == "RAM");
  const test::Reading eds("gen/storage.eds");
  CHECK(group_of(JsonReading(json::write(eds.description))) == "");
}

TEST_CASE("JSON: a text that contradicts its value is an error") {
  CHECK(JsonReading(with(R"("default_value": {"kind": "integer", "value": 5, "text": "4"})")).found() ==
        "2:75 json-contradiction\n");
  CHECK(JsonReading(with(R"("default_value": {"kind": "integer", "value": 5, "text": "$NODEID+5"})")).found() ==
        "2:75 json-contradiction\n");
  CHECK(JsonReading(with(R"("data_type": 2, "default_value": {"kind": "integer", "value": -1, "text": "0xFF"})"))
            .found()
            .empty());
  for (const char* other : {R"(8, "default_value": {"value": 1.5, "text": "2.5"})",
                            R"(10, "default_value": {"kind": "octets", "value": "0102", "text": "0A 0B"})",
                            R"(2, "default_value": {"value": -2, "text": "0"})",
                            R"(7, "default_value": {"value": 384, "node_id": true, "text": "0x180"})"}) {
    CAPTURE(other);
    CHECK(JsonReading(with(std::string(R"("data_type": )") + other)).has("json-contradiction"));
  }
}

TEST_CASE("JSON: a value is interpreted by its data type") {
  CHECK(JsonReading(with(R"("data_type": 5, "default_value": 300)")).has("od-value-range"));
  CHECK(JsonReading(with(R"("data_type": 5, "default_value": 1.5)")).has("od-value-fraction"));
  CHECK(test::meaning(value_of(JsonReading(with(R"("data_type": 8, "default_value": 1)")))) == "1");
  CHECK(test::meaning(value_of(JsonReading(with(R"("data_type": 10, "default_value": 12)")))) == "octets 12");
  CHECK(JsonReading(with(R"("data_type": 5, "default_value": {"kind": "malformed", "text": "five"})"))
            .has("od-value-number"));
}

TEST_CASE("JSON: texts of all characters are kept") {
  Description description;
  Device& device = description.devices.emplace_back();
  const std::string text = "\"\\\b\n\t\x01\x7F/ \xC3\xB6 \xF0\x9F\x98\x80 \\\"";
  device.file.description = {text, {}, true};
  const JsonReading reading(json::write(description));
  CHECK(reading.device().file.description.text == text);
  CHECK(has(std::string(reading.document.source().slice(reading.device().file.description.span)), "\\u000a"));
}

TEST_CASE("JSON: a text that contradicts its number, flag or word is an error") {
  for (const char* members :
       {R"("data_type": {"value": 7, "text": "0x0006"})", R"("sub_number": {"value": 3, "text": "4"})",
        R"("access": {"value": "rw", "text": "ro"})", R"("flags": {"value": 0, "text": "2"})",
        R"("pdo_mapping": {"value": "no", "text": "1"})", R"("node": {"disabled": {"value": false, "text": "1"}})"}) {
    CAPTURE(members);
    const JsonReading reading(with(members));
    CHECK(reading.has("json-contradiction"));
    CHECK(JsonReading(json::write(reading.description)).found().empty());  // the text has priority
  }
  CHECK(JsonReading(with(R"("data_type": {"value": 7, "text": "0x0006"})")).device().objects.at(0).data_type.value ==
        6);
  CHECK(JsonReading(with(R"("data_type": {"value": 7, "text": "0x7"}, "access": {"value": "rw", "text": "RW"},
"pdo_mapping": {"value": "tpdo", "text": "1"}, "flags": {"value": 0, "text": ""})"))
            .found()
            .empty());
}

TEST_CASE("JSON: attributes of XML are hexadecimal or words") {
  std::string xdd = with(R"("data_type": {"value": 12, "text": "0C"}, "flags": {"value": 16, "text": "0010"},
"pdo_mapping": {"value": "rpdo", "text": "RPDO"}, "access": {"value": "rw", "text": "readWrite"})");
  xdd.replace(xdd.find("\"eds\""), 5, "\"xdd11\"");
  CHECK(JsonReading(xdd).found().empty());
}

TEST_CASE("JSON: wrong counts of an EDS are reported") {
  CHECK(JsonReading(with(R"("flags": {"value": 0, "text": "many"})")).found() == "2:48 od-value-number\n");
  CHECK(JsonReading(with(R"("flags": {"value": 8, "text": "010"})")).has("od-value-octal"));
  const JsonReading file(R"({"schema": "codict-device-1", "devices": [{"format": "eds",
"file": {"version": {"value": 0, "text": "300"}}, "features": {"lss_slave": {"value": false, "text": "maybe"}}}]})");
  CHECK(file.found() == "2:43 od-value-range\n2:103 od-value-number\n");
}
