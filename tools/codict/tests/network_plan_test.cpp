// SPDX-License-Identifier: Apache-2.0
// Plans of networks: values that are read, and findings with their places.
#include <doctest/doctest.h>

#include <string>

#include "network/plan.hpp"
#include "network/yaml.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using network::Plan;
using network::read_plan;

namespace {

// Returns "line:column: rule: text" of each finding, one per line.
std::string found(const std::string& yaml) {
  const Source source("plan.yaml", yaml);
  Findings findings;
  read_plan(source, findings);
  std::string text;
  for (const Finding& finding : findings.all()) {
    const Position place = source.position(finding.span.begin);
    text += std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + std::string(finding.rule->id) +
            ": " + finding.text + (finding.hint.empty() ? "" : " (" + finding.hint + ")") + "\n";
  }
  return text;
}

bool starts_with(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

const std::string master = "master: {node_id: 127}\n";

}  // namespace

TEST_CASE("network: a plan has a master, and nodes with their PDOs and values") {
  Findings findings;
  const Plan plan = read_plan(Source("plan.yaml", R"(
options:
  heartbeat_multiplier: 2.5
master:
  node_id: 0x7F
  baudrate: 250
  sync_period: 10000
.template:
  anything: [1, 2]
drive:
  dcf: drive.eds
  node_id: 2
  mandatory: yes
  error_behavior: {1: 0x02}
  tpdo:
    1:
      cob_id: 0x181
      transmission: 1
      mapping:
        - {index: 0x6041, sub_index: 0}
    2: {enabled: false, cob_id: auto}
    3:
  sdo:
    - {index: 0x2000, sub_index: 1, value: -5}
)"),
                              findings);
  CHECK(findings.all().empty());
  CHECK(plan.heartbeat_multiplier.value == 2.5);
  CHECK(plan.master.node_id.value == 127);
  CHECK(plan.master.bit_rate.value == 250);
  CHECK(plan.master.start.value);
  REQUIRE(plan.slaves.size() == 1);
  const network::PlannedSlave& drive = plan.slaves[0];
  CHECK(drive.description.value == "drive.eds");
  CHECK(drive.is_mandatory.value);
  CHECK(drive.is_booted.value);
  CHECK(drive.error_behavior.value == network::ErrorBehavior{{1, 2}});
  REQUIRE(drive.tpdos.size() == 3);
  CHECK(drive.tpdos[0].cob_id.value == 0x181);
  CHECK(drive.tpdos[0].mapping.value[0].index == 0x6041);
  CHECK_FALSE(drive.tpdos[1].is_enabled.value);
  CHECK_FALSE(drive.tpdos[1].cob_id.is_given);
  CHECK(drive.tpdos[2].is_enabled.value);
  CHECK(drive.values[0].text == "-5");
}

TEST_CASE("network: an unknown key is an error that names similar ones") {
  CHECK(found("master: {node_id: 1, sync_periode: 5}\n") ==
        "1:22: net-key: unknown key \"sync_periode\" in master (did you mean sync_period?)\n");
  CHECK(found(master + "a:\n  dcf: a.eds\n  tpdo:\n    1:\n      transmision: 1\n") ==
        "6:7: net-key: unknown key \"transmision\" in a.tpdo.1 (did you mean transmission?)\n");
  CHECK(starts_with(found("master: {node_id: 1, period: 5}\n"), "1:22: net-key: unknown key \"period\" in master"));
}

TEST_CASE("network: a plan of ROS 2 has defaults, nodes below nodes, and keys without effect") {
  Findings findings;
  const Plan plan = read_plan(Source("bus.yml", R"(
master: {node_id: 1, driver: "ros2_canopen::MasterDriver", package: canopen_master_driver}
defaults:
  dcf: drive.eds
  driver: "ros2_canopen::Cia402Driver"
  period: 10
  sdo: [{index: 0x6081, sub_index: 0, value: 1000}]
  tpdo: {1: {transmission: 1}, 3: {enabled: false}}
nodes:
  joint_1: {node_id: 2}
  joint_2: {node_id: 3, period: 20, dcf: other.eds, tpdo: {2: }, namespace: /a}
joint_3: {node_id: 4}
)"),
                              findings);
  REQUIRE(plan.slaves.size() == 3);
  CHECK(plan.slaves[0].name == "joint_1");
  CHECK(plan.slaves[0].node_id.value == 2);
  CHECK(plan.slaves[0].description.value == "drive.eds");
  CHECK(plan.slaves[0].tpdos.size() == 2);
  CHECK(plan.slaves[1].description.value == "other.eds");
  CHECK(plan.slaves[1].tpdos.size() == 1);
  CHECK(plan.slaves[1].values.at(0).text == "1000");
  CHECK(plan.slaves[2].description.value == "drive.eds");
  CHECK(findings.count(Severity::error) == 0);
  std::string texts;
  for (const Finding& finding : findings.all()) {
    texts += std::string(finding.rule->id) + ": " + finding.text + "\n";
  }
  CHECK(texts ==
        "net-defaults: defaults are used for 3 nodes\n"
        "net-key-ros: key \"driver\" has no effect here, only in ROS 2 (2 places)\n"
        "net-key-ros: key \"namespace\" has no effect here, only in ROS 2 (1 place)\n"
        "net-key-ros: key \"package\" has no effect here, only in ROS 2 (1 place)\n"
        "net-key-ros: key \"period\" has no effect here, only in ROS 2 (2 places)\n");
}

TEST_CASE("network: faults in a plan of ROS 2 are reported once, and nodes may be a list") {
  const std::string ros = "master: {node_id: 1, driver: x}\n";
  const std::string driver =
      "1:22: net-key-ros: key \"driver\" has no effect here, only in ROS 2 (1 place) "
      "(remove it if the plan is not for ROS 2)\n";
  CHECK(found(ros + "nodes:\n  - a: {dcf: x}\n  - b: {dcf: x, node_di: 2}\n") ==
        "4:17: net-key: unknown key \"node_di\" in b (did you mean node_id?)\n" + driver);
  CHECK(found(ros + "defaults: {boot: maybe}\nnodes: {a: {node_id: 2}, b: {node_id: 3}}\n") ==
        "2:18: net-value: invalid defaults.boot: \"maybe\" (write true or false)\n");
  CHECK(found(ros + "nodes: {a: {dcf: x}}\na: {dcf: x}\n") ==
        "3:1: net-value: duplicate name of a node: \"a\" (rename one of them)\n" + driver);
  CHECK(found(ros + "nodes: {Master: {dcf: x}}\n").find("duplicate name of a node: \"Master\"") != std::string::npos);
  CHECK(found(ros + "nodes: {a: {dcf: x}, A: {dcf: x}}\n").find("duplicate name of a node: \"A\"") !=
        std::string::npos);
  CHECK(found(ros + "nodes: 1\n") == "2:8: net-value: invalid nodes: \"1\" (write a map)\n" + driver);
  CHECK(found(ros + "a: {dcf: x, tpdo: {1: {period: 1}}}\n").find("net-key: unknown key \"period\" in a.tpdo.1") !=
        std::string::npos);
}

TEST_CASE("network: values of a wrong kind or out of range are errors with what is wanted") {
  CHECK(found("master: {node_id: 128}\n") ==
        "1:19: net-value: invalid master.node_id: \"128\" (write an integer from 1 to 127)\n"
        "1:1: net-missing: master has no node_id (add one: node_id: 127)\n");
  CHECK(found("master: {node_id: 1, start: maybe}\n") ==
        "1:29: net-value: invalid master.start: \"maybe\" (write true or false)\n");
  CHECK(found("master: [1]\n") == "1:9: net-value: invalid master: a list (write a map)\n");
  CHECK(found("master: {node_id: 1, sync_period: -1}\n") ==
        "1:35: net-value: invalid master.sync_period: \"-1\" (write an integer from 0x0 to 0xffffffff)\n");
  CHECK(found(master + "a:\n  dcf: [x]\n") ==
        "3:8: net-value: invalid a.dcf: a list (write one line of text)\n"
        "2:1: net-missing: a has no dcf (add the path of its description: dcf: drive.eds)\n");
  CHECK(found(master + "a: {dcf: a.eds, tpdo: {0: }}\n") ==
        "2:24: net-value: invalid PDO number in a.tpdo: \"0\" (write an integer from 1 to 512)\n");
  CHECK(found(master + "options: {heartbeat_multiplier: .nan}\n") ==
        "2:33: net-value: invalid options.heartbeat_multiplier: \".nan\" (write a number from 1 to 1000)\n");
  CHECK(found(master + "a: {dcf: a.eds, sdo: [{index: 0x2000}]}\n") ==
        "2:23: net-missing: a.sdo: entry without value (write {index: 0x2000, sub_index: 0, value: 1})\n");
}

TEST_CASE("network: the name of a node must be a valid file name") {
  CHECK(
      found(master + "a/b: {dcf: a.eds}\n") ==
      "2:1: net-value: invalid name of a node: \"a/b\" (use at most 64 letters, digits, - and _: files are named after "
      "the node)\n");
}

TEST_CASE("network: a plan without master is an error") {
  CHECK(found("a: {dcf: a.eds}\n") ==
        "1:1: net-missing: the plan has no section master (add one: master: {node_id: 127, baudrate: 250})\n");
  CHECK(found("- 1\n") == "1:1: net-value: invalid plan: a list (write a map)\n");
}

TEST_CASE("network: YAML that is hostile or not YAML is refused with its place") {
  CHECK(found("").find("net-yaml: the plan is empty") != std::string::npos);
  CHECK(found("master: &m {node_id: 1}\na: *m\n") ==
        "1:9: net-yaml: anchors and aliases (&, *) are not supported (write the value out at each place)\n");
  CHECK(found("a: !!python/object 1\n") ==
        "1:4: net-yaml: tags are not supported: tag:yaml.org,2002:python/object (remove the tag)\n");
  CHECK(found("master: {node_id: 1}\nmaster: {node_id: 2}\n") ==
        "2:1: net-yaml: duplicate key master (remove one of them)\n");
  CHECK(found("[a]: 1\n") == "1:1: net-yaml: the name of a value is a list (write a word)\n");
  CHECK(found("a: 1\n---\nb: 1\n").find("net-yaml: a second document") != std::string::npos);
  CHECK(starts_with(found("a: [1\nb: }"), "2:"));
  CHECK(starts_with(found("a:\n\t- b\n"), "2:"));
  CHECK(found(std::string("a: 1\0b", 6)) ==
        "1:5: net-yaml: NUL byte in the plan (remove it, or save the plan as UTF-8)\n");
  CHECK(found("\xFF\xFE") == "1:1: net-yaml: the plan is not UTF-8 text (save it as UTF-8)\n");
}

TEST_CASE("network: deep nesting, large files and too many values are refused") {
  CHECK(found("a: " + std::string(1000, '[')).find("16 levels of nesting") != std::string::npos);
  CHECK(found(std::string(500000, '[')).find("net-yaml") != std::string::npos);
  CHECK(found(std::string(network::yaml::size_limit + 1, 'a')).find("the limit is 1048576") != std::string::npos);
  std::string many = "a: [";
  for (int n = 0; n < 100001; ++n) {
    many += "1,";
  }
  CHECK(found(many + "1]").find("more than 100000 values") != std::string::npos);
}

TEST_CASE("network: any bytes are a plan or are refused") {
  const std::string plan = "master: {node_id: 1}\na:\n  dcf: \"x\"\n  tpdo: {1: {mapping: [{index: 1}]}}\n  sdo: []\n";
  std::uint32_t random = 7;
  for (int n = 0; n < 4000; ++n) {
    std::string bytes = plan;
    for (int change = 0; change < 3; ++change) {
      random = random * 1664525U + 1013904223U;
      constexpr std::string_view letters = "{}[]:,-#&*!|>'\"%@`\n\t ?\\a1\xC3\xFF";
      bytes[(random >> 8) % bytes.size()] = letters[(random >> 20) % letters.size()];
    }
    Findings findings;
    read_plan(Source("plan.yaml", bytes), findings);
  }
}

TEST_CASE("network: docs/network.md lists each key that is read") {
  const std::string page = test::bytes_of(LEXICAN_SOURCE_DIR "/tools/codict/docs/network.md");
  const std::string reader = test::bytes_of(LEXICAN_SOURCE_DIR "/tools/codict/src/network/read_plan.cpp");
  unsigned number = 0;
  for (std::size_t at = reader.find("{\"") + 2; at != 1; at = reader.find("{\"", at) + 2) {
    const std::string key = reader.substr(at, reader.find('"', at) - at);
    CHECK_MESSAGE((page.find("`" + key + "`") != std::string::npos || page.find(key + "}") != std::string::npos ||
                   page.find(key + ",") != std::string::npos),
                  key);
    ++number;
  }
  CHECK(number > 50);
}
