// SPDX-License-Identifier: Apache-2.0
// The causes that `lexican why` names, by logs of simulated devices (scenarios/*.txt).
#include <doctest/doctest.h>

#include <random>
#include <set>

#include "explain/explainer.hpp"
#include "program_bench.hpp"
#include "scenario.hpp"

namespace {

using namespace lexican;
using explain::Explainer;

std::vector<explain::Finding> findings_of(const Scenario& scenario) {
  Explainer explainer(scenario.described, scenario.rate);
  for (const host_bus::Entry& frame : scenario.frames) {
    explainer.process(frame);
  }
  explainer.finish();
  return explainer.findings();
}

std::set<std::string> names_of(const std::vector<explain::Finding>& findings) {
  std::set<std::string> names;
  for (const explain::Finding& finding : findings) {
    names.insert(explain::cause_of(finding.cause).name);
  }
  return names;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " ") + name;
  }
  return text;
}

void check_sections(const std::string& file) {
  for (const Scenario::Section& section : Scenario::sections_of(LEXICAN_TOOL_DIR "/tests/scenarios/" + file)) {
    const Scenario scenario(section);
    const std::string found = joined(names_of(findings_of(scenario)));
    CHECK_MESSAGE(found == joined({section.causes.begin(), section.causes.end()}), file << ", " << section.name);
  }
}

TEST_CASE("why: the cause of a fault, and no other") { check_sections("faults.txt"); }
TEST_CASE("why: faults that an author made who knew only the names of the causes") { check_sections("seeded.txt"); }
TEST_CASE("why: what is near a fault, and none") { check_sections("near.txt"); }
TEST_CASE("why: good buses have no cause") { check_sections("good.txt"); }

/// Any frames, most of them with the identifiers of services of a few nodes, and times that jump.
TEST_CASE("why: a bus of random frames") {
  std::mt19937 random(7);
  const auto any = [&] { return static_cast<std::uint32_t>(random()); };
  const auto below = [&](unsigned limit) { return any() % limit; };
  describe::Network network;
  network.describe(5, description_of(LEXICAN_TOOL_DIR "/tests/fixtures/servo.eds"));
  Explainer explainer(network, 0);
  host_bus::Entry entry;
  entry.time = Scenario::epoch;
  for (int n = 0; n < 60000; ++n) {
    constexpr unsigned functions[] = {0, 1, 3, 4, 5, 6, 11, 12, 12, 14, 15};
    const unsigned node = below(4) == 0 ? below(128) : 4 + below(4);
    const bool is_any = below(10) == 0;
    entry.frame.Identifier = is_any           ? any()
                             : below(20) == 0 ? (below(2) != 0 ? 0x7E4 : 0x7E5)
                                              : functions[below(std::size(functions))] << 7 | node;
    entry.frame.DLC = static_cast<std::uint8_t>(below(4) == 0 ? below(16) : 8);
    for (std::uint8_t& byte : entry.frame.Data) {
      byte = static_cast<std::uint8_t>(below(3) == 0 ? any() : below(2) << 4);
    }
    entry.time = below(1000) == 0 ? entry.time - below(5'000'000) : entry.time + below(3000);
    explainer.process(entry);
  }
  explainer.finish();
  const std::vector<explain::Finding> findings = explainer.findings();
  CHECK(!findings.empty());
  CHECK(findings.size() <= explain::Findings::most_of_cause * std::size(explain::causes));
  for (const explain::Finding& finding : findings) {
    CHECK(!finding.title.empty());
    CHECK(!finding.text.empty());
    CHECK(!finding.check.empty());
    CHECK(finding.evidence.frames().size() <= explain::Evidence::most_frames);
    CHECK(finding.evidence.times().size() <= explain::Evidence::most_times);
    CHECK(finding.evidence.since() <= finding.evidence.until());
  }
}

const std::string servo = "5=" LEXICAN_TOOL_DIR "/tests/fixtures/servo.eds";

/// Writes the log of a section of scenarios/faults.txt. Returns its path.
std::string log_of(const test::Directory& directory, const std::string& name) {
  const std::string path = directory / (name + ".log");
  for (const Scenario::Section& section : Scenario::sections_of(LEXICAN_TOOL_DIR "/tests/scenarios/faults.txt")) {
    if (section.name == name) {
      Scenario(section).write_log(path);
    }
  }
  return path;
}

TEST_CASE("lexican why: a log in words") {
  const test::Directory directory;
  const std::string log = log_of(directory, "consumer-too-short");
  const test::Ran ran = test::run({"why", log, "--eds", servo});
  CHECK(ran.out ==
        "1 node 5 refuses to stay Operational (since 2.202 s)\n"
        "  It expects a heartbeat of node 127 every 200 ms (1016h:01) and sends EMCY 8130h; node 127 sends one every "
        "1 s.\n"
        "       2.202 085#30811100007F0000  EMCY 8130h of node 5\n"
        "       3.000 77F#05  heartbeat of node 127, 999 ms after the one before\n"
        "       4.000 77F#05  heartbeat of node 127, 1 s after the one before\n"
        "  check: lexican read 5 1016:1; lexican read 127 1017\n"
        "  fix: lexican write 5 1016:1 0x007F05DC\n"
        "  page: heartbeat-time\n\n");
  CHECK(ran.err == "");
  CHECK(ran.status == 1);
  CHECK(test::has(test::run({"why", log, "--node", "9"}).out, "no known cause of a fault of these nodes in "));
  CHECK(test::run({"why", log, "--node", "9"}).status == 0);
  CHECK(test::run({"why", log, "--node", "0"}).status == 2);
  CHECK(test::run({"why", log, "-i", "hub:x"}).err == "lexican: give a log, or -i, and not both\n");
}

TEST_CASE("lexican why: as JSON, and a log without a fault or without frames") {
  const test::Directory directory;
  const test::Ran json = test::run({"why", log_of(directory, "rpdo-never"), "--json"});
  CHECK(json.status == 0);  // without a description, an RPDO is unknown
  CHECK(json.out == "");
  const test::Ran found = test::run({"why", log_of(directory, "refused-range"), "--eds", servo, "--json"});
  CHECK(found.status == 1);
  CHECK(test::fault_of(found.out, "why") == "");
  const nlohmann::json line = nlohmann::json::parse(found.out);
  CHECK(line["cause"] == "sdo-refused");
  CHECK(line["node"] == 5);
  CHECK(line["frames"].size() == 3);
  CHECK(line["fix"] == "the object is read-only: do not write it");
  const std::string empty = directory / "empty.log";
  test::write_bytes(empty, "(1.000000) can0 080#\n");
  const test::Ran good = test::run({"why", empty});
  CHECK(good.out == "no known cause of a fault in 1 frames, 0.000 s\n");
  CHECK(good.status == 0);
}

TEST_CASE("lexican mon --html: the page has the causes") {
  const test::Directory directory;
  const std::string page = directory / "fault.html";
  CHECK(test::run({"mon", log_of(directory, "refused-range"), "--eds", servo, "--html", page}).status == 0);
  CHECK(test::has(test::bytes_of(page), "node 5 refuses to write 1000h Device type again and again"));
}

TEST_CASE("lexican why: a bus, until Ctrl-C") {
  test::Bench bench{5};
  test::Process why(bench.line("why", {}), bench.environment());
  for (int n = 0; n < 4; ++n) {
    bench.run("write", {"5", "1000", "0x1", "--type", "u32"});
  }
  why.wait_for("again and again");
  why.send(SIGINT);
  const test::Ran ran = why.finish();
  CHECK(test::has(ran.out, "1 node 5 refuses to write 1000h:00 device type again and again"));
  CHECK(ran.status == 1);
}

TEST_CASE("why: each cause has a page with its title") {
  for (const explain::Cause& cause : explain::causes) {
    const std::string page = bytes_of_file(std::string(LEXICAN_TOOL_DIR "/docs/causes/") + cause.name + ".md");
    CHECK(page.substr(0, page.find('\n')) == std::string("# ") + cause.title);
    CHECK(&explain::cause_of(cause.id) == &cause);
  }
}

}  // namespace
