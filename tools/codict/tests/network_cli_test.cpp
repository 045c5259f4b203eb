// SPDX-License-Identifier: Apache-2.0
// The command codict network: output, files and exit status.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "directory.hpp"
#include "program.hpp"
#include "reading.hpp"

using test::has;
using test::Ran;

TEST_CASE("codict network: a plan is checked and its files are written") {
  const test::Directory directory;
  const Ran ran = test::run_codict(directory / "", "network '" + test::fixture("network/plan.yaml") + "' -o out");
  CHECK(ran.err == "");
  CHECK(ran.status == 0);
  CHECK(ran.out.find("4 nodes, 6 PDO links, 250 kbit/s; bus load: worst case 47.7 %, average 18.9 %\n") == 0);
  for (const char* name : {"drive_x.dcf", "drive_x.bin", "io.dcf", "io.bin", "master.dcf", "network.html"}) {
    CHECK_MESSAGE(std::filesystem::exists(directory / "out" + "/" + name), name);
  }
  // The DCFs describe the same network; the master has one, too.
  const Ran again = test::run_codict(directory / "out", "network drive_x.dcf drive_y.dcf io.dcf master.dcf");
  CHECK(again.err == "");
  CHECK(again.out == ran.out);
  CHECK(test::run_codict(directory / "out", "check master.dcf drive_x.dcf io.dcf").out == "");
}

TEST_CASE("codict network: findings have their place in the plan; nothing is written with errors") {
  const test::Directory directory;
  std::string plan = test::bytes_of(test::fixture("network/plan.yaml"));
  test::copy_to(directory, "network/drive.eds");
  test::copy_to(directory, "network/io.eds");
  plan.replace(plan.find("node_id: 3"), 10, "node_id: 2");
  test::write_bytes(directory / "plan.yaml", plan);
  const Ran ran = test::run_codict(directory / "", "network plan.yaml -o out");
  CHECK(ran.status == 1);
  CHECK(has(ran.err, "error: drive_x and drive_y have the node-ID 2 [net-node-id]\n    drive_y:\n    ^"));
  CHECK_FALSE(has(ran.err, "net-cob-id"));
  CHECK(has(ran.err, "codict: errors, no file was written"));
  CHECK_FALSE(std::filesystem::exists(directory / "out"));
  CHECK(test::run_codict(directory / "", "network plan.yaml -o out --force").status == 1);
  CHECK(std::filesystem::exists(directory / "out/io.bin"));
}

TEST_CASE("codict network: an unknown key and a missing description are reported") {
  const test::Directory directory;
  test::write_bytes(directory / "plan.yaml", "master: {node_id: 1, drive: x}\n");
  Ran ran = test::run_codict(directory / "", "network plan.yaml");
  CHECK(ran.status == 1);
  CHECK(has(ran.err, "plan.yaml:1:22: error: unknown key \"drive\" in master [net-key]\n"));
  test::write_bytes(directory / "plan.yaml", "master: {node_id: 1}\na: {dcf: none.eds, node_id: 2}\n");
  ran = test::run_codict(directory / "", "network plan.yaml");
  CHECK(ran.status == 2);
  CHECK(has(ran.err, "none.eds"));
}

TEST_CASE("codict network: wrong usage is reported") {
  const test::Directory directory;
  CHECK(test::run_codict(directory / "", "network a.yaml b.dcf").status == 2);
  CHECK(test::run_codict(directory / "", "network none.yaml").status == 2);
}

TEST_CASE("codict network: an input is not overwritten") {
  const test::Directory directory;
  const std::string plan = test::copy_to(directory, "network/plan.yaml");
  test::copy_to(directory, "network/io.eds");
  std::filesystem::copy_file(test::fixture("network/drive.eds"), directory / "drive.eds");
  const Ran ran = test::run_codict(directory / "", "network plan.yaml -o .");
  CHECK(ran.status == 0);
  const Ran again = test::run_codict(directory / "", "network drive_x.dcf drive_y.dcf io.dcf master.dcf -o .");
  CHECK(again.status == 2);
  CHECK(has(again.err, "drive_x.dcf: an output would overwrite an input"));
}

TEST_CASE("codict network: JSON is printed for programs") {
  const Ran ran = test::run("network network/plan.yaml --json");
  CHECK(ran.status == 0);
  CHECK(has(ran.out, "\"schema\": \"codict-network-1\""));
  CHECK(has(ran.out, "\"worst_load_permille\": 477"));
  CHECK(has(ran.out, "\"response_ns\": 744000"));
}

TEST_CASE("codict explain: a rule of networks has a page with a remedy and examples") {
  const Ran ran = test::run("explain net-cob-id");
  CHECK(ran.status == 0);
  CHECK(has(ran.out, "### net-cob-id\n\nerror: COB-ID that two services of the network transmit\n"));
  CHECK(has(ran.out, "\nRemedy: "));
  CHECK(has(ran.out, "\n```yaml\n"));
  CHECK(has(ran.out, "tools/codict/docs/rules.md#net-cob-id\n"));
  CHECK(has(test::run("explain net-cob-id --json").out, "\"rule\": \"net-cob-id\""));
  CHECK(has(test::run("explain").out, "net-cob-id "));
}
