// SPDX-License-Identifier: Apache-2.0
// Networks: checks between nodes, configuration by a plan, concise DCFs, bus load, the report.
#include <doctest/doctest.h>

#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "network/check.hpp"
#include "network/concise.hpp"
#include "network/links.hpp"
#include "network/network.hpp"
#include "network/plan.hpp"
#include "network/report.hpp"
#include "network/traffic.hpp"
#include "program.hpp"
#include "reading.hpp"

using namespace lexican::codict;
using namespace lexican::codict::network;

namespace {

Device device_of(const std::string& eds) {
  Findings findings;
  const eds::Document document(Source("device.eds", eds), findings);
  return eds::read(document, findings).devices.front();
}

std::string hexadecimal(std::uint64_t value) {
  std::string digits;
  for (; value != 0 || digits.empty(); value >>= 4) {
    digits.insert(digits.begin(), "0123456789ABCDEF"[value & 0xF]);
  }
  return digits;
}

std::string variable(unsigned index, unsigned type, const std::string& value, const std::string& access = "rw") {
  return "[" + hexadecimal(index) + "]\nParameterName=x\nDataType=" + std::to_string(type) + "\nAccessType=" + access +
         "\nDefaultValue=" + value + "\nPDOMapping=1\n";
}

std::string record(unsigned index, const std::map<unsigned, std::string>& values) {
  std::string text = "[" + hexadecimal(index) + "]\nParameterName=x\nObjectType=9\n";
  for (const auto& [sub_index, value] : values) {
    text += "[" + hexadecimal(index) + "sub" + hexadecimal(sub_index) +
            "]\nParameterName=x\nDataType=7\nAccessType=rw\nDefaultValue=" + value + "\n";
  }
  return text;
}

std::string commissioned(unsigned node_id, const std::string& objects, const std::string& more = "") {
  return "[DeviceComissioning]\nNodeID=" + std::to_string(node_id) + "\nBaudrate=250\n" + more + objects;
}

// Returns a TPDO or RPDO that maps `count` objects of 16 bits.
std::string pdo(unsigned communication, const std::string& cob_id, const std::string& type, unsigned count,
                const std::string& inhibit = "100", const std::string& event = "0") {
  std::map<unsigned, std::string> mapping = {{0, std::to_string(count)}};
  for (unsigned n = 1; n <= count; ++n) {
    mapping[n] = "0x20000010";
  }
  return record(communication, {{0, "5"}, {1, cob_id}, {2, type}, {3, inhibit}, {5, event}}) +
         record(communication + 0x200, mapping) + variable(0x2000, 6, "0");
}

const std::string sync_master =
    "[1005]\nParameterName=x\nDataType=7\nAccessType=rw\nDefaultValue=0x40000080\n"
    "[1006]\nParameterName=x\nDataType=7\nAccessType=rw\nDefaultValue=10000\n";

Network network_of(const std::vector<std::string>& descriptions) {
  std::vector<NamedDevice> devices;
  for (const std::string& eds : descriptions) {
    const char letter = static_cast<char>('a' + devices.size());
    devices.push_back({std::string(1, letter), std::string(1, letter) + ".dcf", device_of(eds)});
  }
  return described_network(std::move(devices), 0);
}

std::string text_of(const NetworkFindings& findings, Severity least) {
  std::string text;
  std::vector<const Findings*> all = {&findings.plan};
  for (const Findings& each : findings.nodes) {
    all.push_back(&each);
  }
  for (const Findings* each : all) {
    for (const Finding& finding : each->all()) {
      if (finding.severity >= least) {
        text += std::string(finding.rule->id) + ": " + finding.text + "\n";
      }
    }
  }
  return text;
}

// Returns the findings of all checks, from severity `least` on.
std::string found(const std::vector<std::string>& descriptions, Severity least = Severity::warning) {
  const Network network = network_of(descriptions);
  NetworkFindings findings(network);
  const Links links = links_of(network);
  check_all(network, links, findings);
  traffic_of(network, links, findings);
  return text_of(findings, least);
}

struct Configured {
  Network network;
  Findings findings;

  std::string text() const {
    std::string text;
    for (const Finding& finding : findings.all()) {
      text += std::string(finding.rule->id) + ": " + finding.text + "\n";
    }
    return text;
  }
};

// Returns the network of a plan in which all slaves have the same description.
Configured planned(const std::string& yaml, const std::string& eds) {
  Configured result;
  const Plan plan = read_plan(Source("plan.yaml", yaml), result.findings);
  result.network = planned_network(plan, std::vector<Device>(plan.slaves.size(), device_of(eds)), result.findings);
  return result;
}

Configured example() {
  Configured result;
  const std::string directory = test::fixture("network/");
  const Plan plan = read_plan(Source("plan.yaml", test::bytes_of(directory + "plan.yaml")), result.findings);
  std::vector<Device> devices;
  for (const PlannedSlave& slave : plan.slaves) {
    devices.push_back(device_of(test::bytes_of(directory + slave.description.value)));
  }
  result.network = planned_network(plan, std::move(devices), result.findings);
  return result;
}

// Returns "1800:1=81010080 …": values as SDO transfers them, low byte first.
std::string downloads_text(const std::vector<Download>& downloads) {
  std::string text;
  for (const Download& download : downloads) {
    text += (text.empty() ? "" : " ") + hexadecimal(download.index) + ":" + std::to_string(download.sub_index) + "=" +
            hexadecimal_octets(download.bytes);
  }
  return text;
}

const std::string heartbeat_100 = variable(0x1017, 6, "100");

}  // namespace

TEST_CASE("network: a node-ID that two nodes have, or a missing one, is an error") {
  const std::string emcy = variable(0x1014, 7, "$NODEID+0x80");
  CHECK(found({commissioned(2, emcy), commissioned(2, emcy)}) == "net-node-id: a and b have the node-ID 2\n");
  CHECK(found({variable(0x2000, 6, "0")}) == "net-node-id: a has no node-ID\n");
  CHECK(found({heartbeat_100}, Severity::note).find("no node monitors a: its") != std::string::npos);
}

TEST_CASE("network: bit rates must be equal and supported") {
  CHECK(found({commissioned(2, ""), "[DeviceComissioning]\nNodeID=3\nBaudrate=500\n"}) ==
        "net-bit-rate: b (node 3) is configured for 500 kbit/s, the network has 250 kbit/s\n");
  CHECK(found({commissioned(2, "", "[DeviceInfo]\nBaudRate_125=1\nBaudRate_250=0\n")}) ==
        "net-bit-rate: a (node 2) does not support 250 kbit/s\n");
}

TEST_CASE("network: a COB-ID that two nodes transmit is an error for every service") {
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 1)), commissioned(3, pdo(0x1801, "0x181", "255", 1))},
              Severity::error) ==
        "net-cob-id: COB-ID 181h of b (node 3), TPDO 2, is also that of a (node 2), TPDO 1\n");
  CHECK(found({commissioned(2, ""), commissioned(3, pdo(0x1800, "0x702", "255", 1))}, Severity::error) ==
        "net-cob-id: COB-ID 702h of b (node 3), TPDO 1, is also that of a (node 2), Heartbeat\n");
  CHECK(found({commissioned(2, ""), commissioned(3, pdo(0x1800, "0x582", "255", 1))}, Severity::error)
            .find("SDO server 1, response") != std::string::npos);
  CHECK(found({commissioned(2, sync_master), commissioned(3, pdo(0x1800, "0x80", "255", 1))}, Severity::error)
            .find("is also that of a (node 2), SYNC") != std::string::npos);
  // A COB-ID of 29 bits differs from one of 11 bits; bit 31 disables the PDO.
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 1)), commissioned(3, pdo(0x1800, "0x20000181", "255", 1)),
               commissioned(4, pdo(0x1800, "0x80000181", "255", 1))},
              Severity::error)
            .empty());
  CHECK(found({commissioned(1, variable(0x1005, 7, "0x60000181") + variable(0x1006, 7, "10000")),
               commissioned(3, pdo(0x1800, "0x181", "255", 1))},
              Severity::error)
            .empty());
}

TEST_CASE("network: SDO and EMCY COB-IDs of a description without the node-ID have that of the node") {
  const std::string sdo = record(0x1200, {{1, "0x600"}, {2, "0x580"}}) + variable(0x1014, 7, "0x80");
  CHECK(found({commissioned(2, sdo), commissioned(3, sdo)}).empty());
}

TEST_CASE("network: a TPDO without consumer and an RPDO without producer are warnings") {
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 1)), commissioned(3, pdo(0x1400, "0x182", "255", 1))}) ==
        "net-pdo-no-consumer: TPDO 1 of a (node 2) (181h) has no consumer: no node has an RPDO with this COB-ID\n"
        "net-pdo-no-producer: RPDO 1 of b (node 3) (182h) has no producer: no node has a TPDO with this COB-ID\n");
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 2)), commissioned(3, pdo(0x1400, "0x181", "255", 2))})
            .empty());
}

TEST_CASE("network: a TPDO that is too short is an error; one that is longer a warning") {
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 1)), commissioned(3, pdo(0x1400, "0x181", "255", 2))}) ==
        "net-pdo-short: RPDO 1 of b (node 3) maps 4 bytes, TPDO 1 of a (node 2) has 2 (181h): it is dropped, with EMCY "
        "8210h\n");
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 2)), commissioned(3, pdo(0x1400, "0x181", "255", 1))}) ==
        "net-pdo-long: RPDO 1 of b (node 3) maps 2 bytes, TPDO 1 of a (node 2) has 4 (181h): the last ones are not "
        "used\n");
}

TEST_CASE("network: the deadline of an RPDO must exceed the period of its TPDO") {
  const std::string tpdo = commissioned(2, pdo(0x1800, "0x181", "255", 1, "100", "50"));
  CHECK(found({tpdo, commissioned(3, pdo(0x1400, "0x181", "255", 1, "0", "50"))}) ==
        "net-pdo-deadline: RPDO 1 of b (node 3) has a deadline of 50 ms; TPDO 1 of a (node 2) comes every 50 ms "
        "(181h)\n");
  CHECK(found({tpdo, commissioned(3, pdo(0x1400, "0x181", "255", 1, "0", "51"))}).empty());
  // The event timer has no effect on TPDOs of the types 0 to 253.
  for (const char* type : {"0", "252", "253"}) {
    CAPTURE(type);
    CHECK(found({commissioned(1, sync_master), commissioned(2, pdo(0x1800, "0x181", type, 1, "100", "50")),
                 commissioned(3, pdo(0x1400, "0x181", "255", 1, "0", "50"))})
              .find("net-pdo-deadline") == std::string::npos);
  }
}

TEST_CASE("network: a heartbeat consumer needs a faster producer") {
  CHECK(
      found({commissioned(2, heartbeat_100), commissioned(3, record(0x1016, {{1, "0x20064"}}))}) ==
      "net-heartbeat-time: b (node 3) expects the heartbeat of a (node 2) within 100 ms, and it comes every 100 ms\n");
  CHECK(found({commissioned(2, heartbeat_100), commissioned(3, record(0x1016, {{1, "0x20065"}}))}).empty());
  CHECK(found({commissioned(2, ""), commissioned(3, record(0x1016, {{1, "0x20064"}}))}) ==
        "net-heartbeat-producer: b (node 3) expects the heartbeat of a (node 2), which produces none (1017h is 0)\n");
  CHECK(found({commissioned(3, record(0x1016, {{1, "0x90064"}}))}) ==
        "net-heartbeat-producer: a (node 3) expects the heartbeat of node 9, which is not in the network\n");
  CHECK(found({commissioned(2, heartbeat_100)}, Severity::note) ==
        "net-unmonitored: no node monitors a (node 2): its failure is not detected\n");
}

TEST_CASE("network: life guarding needs a master that guards in time and no heartbeat") {
  const std::string life = variable(0x100C, 6, "100") + variable(0x100D, 5, "2");
  const auto master = [](const std::string& assignment) {
    return commissioned(1, record(0x1F81, {{2, assignment}}), "CANopenManager=1\n");
  };
  CHECK(found({commissioned(2, life)}) ==
        "net-guarding: a (node 2) has life guarding (200 ms), and no master guards it (1F81h)\n");
  CHECK(found({master("0x00C80201"), commissioned(2, life)}) ==
        "net-guarding: b (node 2) is guarded every 200 ms, its life time ends after 200 ms\n");
  CHECK(found({master("0x00640201"), commissioned(2, life)}).empty());
  CHECK(found({commissioned(2, life + heartbeat_100)}) ==
        "net-heartbeat-guarding: a (node 2) has heartbeat (1017h) and guarding: the heartbeat is used\n");
}

TEST_CASE("network: synchronous PDOs need one SYNC producer with a period") {
  const std::string tpdo = pdo(0x1800, "0x181", "1", 1);
  const std::string rpdo = pdo(0x1400, "0x181", "1", 1);
  CHECK(found({commissioned(2, tpdo), commissioned(3, rpdo)}) ==
        "net-sync-missing: TPDO 1 of a (node 2) is synchronous (transmission type 1), and no node produces SYNC\n");
  CHECK(found({commissioned(1, sync_master), commissioned(2, tpdo), commissioned(3, rpdo)}).empty());
  CHECK(found({commissioned(1, sync_master), commissioned(2, sync_master)}) ==
        "net-sync-producers: a (node 1) and b (node 2) produce SYNC (bit 30 of 1005h)\n");
  CHECK(found({commissioned(1, variable(0x1005, 7, "0x40000080"))}) ==
        "net-sync-period: a (node 1) produces SYNC with a period (1006h) of 0: it transmits none\n");
  CHECK(found({commissioned(1, sync_master), commissioned(2, tpdo + variable(0x1005, 7, "0x81")),
               commissioned(3, rpdo + variable(0x1006, 7, "5000"))}) ==
        "net-sync-cob-id: b (node 2) expects SYNC with 081h, a (node 1) transmits it with 080h\n"
        "net-sync-period: c (node 3) expects SYNC every 5000 us (1006h), a (node 1) transmits it every 10000 us\n");
  CHECK(
      found({commissioned(1, sync_master + variable(0x1019, 5, "10")), commissioned(2, tpdo + variable(0x1019, 5, "0")),
             commissioned(3, rpdo)}) ==
      "net-sync-counter: b (node 2) has the SYNC counter overflow value 0 (1019h), a (node 1) has 10: SYNC has another "
      "length\n");
}

TEST_CASE("network: events without a minimum distance are a warning") {
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 1, "0", "50")),
               commissioned(3, pdo(0x1400, "0x181", "255", 1))}) ==
        "net-event-unbounded: TPDO 1 of a (node 2) (181h) has no inhibit time: the worst case counts its event timer "
        "only\n");
}

TEST_CASE("network: the bus load uses the shortest and the usual period of frames") {
  const Network network =
      network_of({commissioned(2, pdo(0x1800, "0x181", "255", 2, "100", "50") + heartbeat_100),
                  commissioned(3, pdo(0x1400, "0x181", "255", 2) + record(0x1016, {{1, "0x20190"}}))});
  NetworkFindings findings(network);
  const Traffic traffic = traffic_of(network, links_of(network), findings);
  CHECK(findings.count(Severity::warning) == 0);
  // 95 bits every 10 ms, and a heartbeat every 100 ms, at 250 kbit/s.
  const double heartbeat = exact_bits({0x702, false, false, 1}, "\x05");
  CHECK(traffic.worst_load == doctest::Approx(100.0 * (95 / 2500.0 + heartbeat / 25000.0)));
  CHECK(traffic.average_load ==
        doctest::Approx(100.0 * (mean_bits({0x181, false, false, 4}) / 12500.0 + heartbeat / 25000.0)));
  // The TPDO is blocked by an SDO frame of 135 bits that has just begun.
  const auto tpdo = std::find_if(traffic.messages.begin(), traffic.messages.end(),
                                 [](const Message& message) { return message.service == "TPDO 1"; });
  REQUIRE(tpdo != traffic.messages.end());
  CHECK(tpdo->response == (95 + 135) * 4000);
}

TEST_CASE("network: synchronous PDOs have the period of their SYNCs, and the window as deadline") {
  const Network network =
      network_of({commissioned(1, sync_master + variable(0x1007, 7, "400")),
                  commissioned(2, pdo(0x1800, "0x181", "4", 4)), commissioned(3, pdo(0x1400, "0x181", "4", 4))});
  NetworkFindings findings(network);
  const Traffic traffic = traffic_of(network, links_of(network), findings);
  const auto tpdo = std::find_if(traffic.messages.begin(), traffic.messages.end(),
                                 [](const Message& message) { return message.service == "TPDO 1"; });
  REQUIRE(tpdo != traffic.messages.end());
  CHECK(tpdo->shortest_period == 40000000);
  CHECK(tpdo->deadline == 400000);
  // An SDO frame (540 us) and SYNC are transmitted before it.
  CHECK(text_of(findings, Severity::warning).find("net-response: TPDO 1 of b (node 2) (181h) takes up to 1.") == 0);
}

TEST_CASE("network: a load above the limit is a warning") {
  CHECK(found({commissioned(2, pdo(0x1800, "0x181", "255", 4, "6")), commissioned(3, pdo(0x1400, "0x181", "255", 4))})
            .find("net-load: worst-case bus load 90.0 %, the limit is 70.0 %\n") != std::string::npos);
}

TEST_CASE("network: the example has no warnings; the master mirrors the PDOs of the nodes") {
  const Configured plan = example();
  CHECK(plan.text() == "");
  NetworkFindings findings(plan.network);
  const Links links = links_of(plan.network);
  check_all(plan.network, links, findings);
  const Traffic traffic = traffic_of(plan.network, links, findings);
  CHECK(text_of(findings, Severity::warning) == "");
  CHECK(links.links.size() == 6);
  CHECK(traffic.worst_load > traffic.average_load);
  const Node& master = plan.network.nodes.back();
  CHECK(master.is_master);
  CHECK(master.number(0x1016, 1) == 0x2012C);
  CHECK(master.number(0x1F80, 0) == 0x11);
  CHECK(master.number(0x1F81, 2) == 0xD);
  CHECK(master.number(0x1F81, 4) == 0);
  CHECK(master.number(0x1F81, 5) == 0x5);
  CHECK(master.number(0x1F84, 5) == 0x30191);
  CHECK(master.number(0x1F89, 0) == 5000);
  CHECK(master.number(0x1400, 1) == 0x182);
  CHECK(master.number(0x1600, 2) == 0x20000220);
  CHECK(master.number(0x1402, 5) == 350);
  CHECK(master.device.find(0x1F22, 3)->upload_file->text == "config/drive_y.bin");
  CHECK(master.device.find(0x2000, 2)->name.text == "drive_x: Position actual value");
  CHECK(plan.network.nodes[0].number(0x1016, 1) == 0x7F0258);
}

TEST_CASE("network: a concise DCF disables a PDO while it changes, with values in SDO byte order") {
  const Configured plan = example();
  NetworkFindings findings(plan.network);
  const std::vector<Download> downloads = downloads_of(plan.network, 0, findings);
  CHECK(downloads_text(downloads) ==
        "1016:1=58027F00 1017:0=6400 1029:1=02 2000:0=FA00 2001:0=00001040 2002:0=617869732058 "
        "1400:1=02020080 1400:2=01 1600:0=00 1600:1=10004060 1600:2=20007A60 1600:0=02 1400:1=02020000 "
        "1800:1=82010080 1800:2=01 1A00:0=00 1A00:1=10004160 1A00:2=20006460 1A00:0=02 1800:1=82010000");
  const std::string bytes = concise_dcf(downloads);
  CHECK(hexadecimal_octets(bytes.substr(0, 15)) ==
        "14000000"
        "1610"
        "01"
        "04000000"
        "58027F00");
  CHECK(concise_dcf({}) == std::string(4, '\0'));
}

TEST_CASE("network: a value that does not fit its type is not downloaded, nor is its PDO") {
  const std::string entries = variable(0x2010, 5, "$NODEID+0xFF") + variable(0x2011, 7, "$NODEID+0xFFFFFFFF") +
                              variable(0x2012, 5, "$NODEID+0xFA") + pdo(0x1800, "$NODEID+0xFFFFFFFF", "255", 1);
  const std::string dcf = std::regex_replace(entries, std::regex("DefaultValue="), "ParameterValue=");
  std::string uncoded;
  const std::vector<Download> downloads =
      lexican::codict::downloads_of(device_of(dcf), 5, [&](std::uint16_t index, std::uint8_t sub_index, const Entry&) {
        uncoded += std::to_string(index) + ':' + std::to_string(sub_index) + ' ';
      });
  CHECK(downloads_text(downloads) == "2000:0=0000 2012:0=FF");
  CHECK(uncoded == "8208:0 8209:0 6144:1 ");
}

TEST_CASE("network: the generated files of the example are read as the same network") {
  const Configured plan = example();
  NetworkFindings findings(plan.network);
  const std::vector<File> files = configuration_files(plan.network, findings);
  std::vector<std::string> names;
  std::vector<NamedDevice> devices;
  for (const File& file : files) {
    names.push_back(file.name);
    if (file.name.find(".dcf") != std::string::npos) {
      devices.push_back({file.name, file.name, device_of(file.bytes)});
    }
  }
  CHECK(names == std::vector<std::string>{"drive_x.dcf", "drive_x.bin", "drive_y.dcf", "drive_y.bin", "io.dcf",
                                          "io.bin", "master.dcf"});
  const Network again = described_network(std::move(devices), 0);
  CHECK(again.bit_rate == 250);
  CHECK(again.nodes.back().is_master);
  NetworkFindings none(again);
  const Links links = links_of(again);
  check_all(again, links, none);
  CHECK(text_of(none, Severity::warning) == "");
  CHECK(links.links.size() == 6);
}

TEST_CASE("network: objects missing in a description cannot be configured") {
  const std::string yaml = "master: {node_id: 1}\na:\n  dcf: x\n  node_id: 2\n";
  CHECK(planned(yaml + "  heartbeat_producer: 5\n", "").text() ==
        "net-object: a: 1017h:0 (heartbeat_producer) is not in the description\n");
  CHECK(planned(yaml + "  heartbeat_producer: 0\n", "").text() == "");
  CHECK(planned(yaml + "  heartbeat_consumer: true\n", "").text() ==
        "net-heartbeat-producer: a monitors the master, which produces no heartbeat\n");
  CHECK(planned(yaml + "  sdo: [{index: 0x2000, value: 1}]\n", variable(0x2000, 6, "0", "ro")).text() ==
        "net-object: a: 2000h:0 (sdo) is ro: it cannot be configured\n");
  CHECK(planned(yaml + "  sdo: [{index: 0x2000, value: 65536}]\n", variable(0x2000, 6, "0")).text() != "");
  CHECK(test::has(planned(yaml + "  sdo: [{index: 0x2000, value: 255}]\n", variable(0x2000, 2, "0")).text(),
                  "'255' does not fit INTEGER8 (-128 to 127)"));
  CHECK(planned(yaml + "  tpdo: {1: }\n", "").text() ==
        "net-object: a has no tpdo 1: there is no 1800h in the description\n");
  const std::string tpdo = pdo(0x1800, "0x181", "255", 4);
  CHECK(planned(yaml + "  tpdo: {1: {mapping: [{index: 0x2001}]}}\n", tpdo).text() ==
        "net-mapping: a: tpdo 1 maps 2001h:0, which is not in the description\n");
  CHECK(planned(yaml + "  tpdo: {1: {mapping: [{index: 5}]}}\n", tpdo).text() ==
        "net-mapping: a: tpdo 1 maps 0005h:0, a dummy, which only RPDOs may map\n");
  CHECK(planned(yaml + "  tpdo: {1: {mapping: [{index: 0x2000}, {index: 0x2000}]}}\n", tpdo)
            .network.nodes[0]
            .number(0x1A00, 0) == 2);
}

TEST_CASE("network: a PDO can be disabled and can have a 29-bit COB-ID") {
  const std::string yaml = "master: {node_id: 1, pdo: none}\na:\n  dcf: x\n  node_id: 2\n";
  const std::string tpdo = pdo(0x1800, "0x181", "255", 1);
  CHECK(planned(yaml + "  tpdo: {1: {enabled: false}}\n", tpdo).network.nodes[0].number(0x1800, 1) == 0x80000181);
  CHECK(planned(yaml + "  tpdo: {1: {cob_id: 0x12345}}\n", tpdo).network.nodes[0].number(0x1800, 1) == 0x20012345);
  CHECK(planned(yaml + "  tpdo: {1: }\n", pdo(0x1800, "0x80000000", "255", 1)).text() ==
        "net-missing: a: tpdo 1 has no COB-ID\n");
}

TEST_CASE("network: the plan selects the PDOs that the master mirrors") {
  const std::string tpdos = pdo(0x1800, "$NODEID+0x180", "255", 1) +
                            record(0x1801, {{1, "$NODEID+0x280"}, {2, "255"}}) +
                            record(0x1A01, {{0, "1"}, {1, "0x20000010"}});
  const auto links = [&tpdos](const std::string& choice) {
    const std::string yaml = "master: {node_id: 1, pdo: " + choice + "}\na: {dcf: x, node_id: 2, tpdo: {2: }}\n";
    return links_of(planned(yaml, tpdos).network).links.size();
  };
  CHECK(links("all") == 2);
  CHECK(links("planned") == 1);
  CHECK(links("none") == 0);
}

TEST_CASE("network: the report escapes names and contains pictures, links and findings") {
  const Network network = network_of({commissioned(2, pdo(0x1800, "0x181", "255", 1), "NetworkName=<Axis & more>\n"),
                                      commissioned(3, pdo(0x1400, "0x181", "255", 2))});
  NetworkFindings findings(network);
  const Links links = links_of(network);
  check_all(network, links, findings);
  const Traffic traffic = traffic_of(network, links, findings);
  const std::string page = html_report(network, links, traffic, findings);
  CHECK(test::has(page, "<h1>&lt;Axis &amp; more&gt;</h1>"));
  CHECK(test::has(page, "<svg class=\"network\""));
  CHECK(test::has(page, "<td>181h</td><td>a TPDO 1</td>"));
  CHECK(test::has(page, "net-pdo-short"));
  CHECK_FALSE(test::has(page, "<script"));
  CHECK(page == html_report(network, links, traffic, findings));
}

TEST_CASE("network: many PDOs with one COB-ID need limited time and memory") {
  std::string eds = commissioned(2, variable(0x2000, 6, "0"));
  for (unsigned n = 0; n < 60; ++n) {
    eds += record(0x1400 + n, {{1, "0x181"}, {2, "255"}}) + record(0x1800 + n, {{1, "0x181"}, {2, "255"}});
  }
  const Network network = network_of(std::vector<std::string>(12, eds));
  NetworkFindings findings(network);
  const Links links = links_of(network);
  CHECK(links.pdos.size() == 1440);
  CHECK(links.links.size() == link_limit);
  check_all(network, links, findings);
  CHECK(traffic_of(network, links, findings).messages.size() > 720);
}

TEST_CASE("network: SRDOs are transmitted with their refresh time by one node and received by others") {
  const auto srdo = [](const char* direction) {
    return record(0x1301, {{0, "6"}, {1, direction}, {2, "25"}, {3, "20"}, {4, "254"}, {5, "0x103"}, {6, "0x104"}}) +
           record(0x1381, {{0, "2"}, {1, "0x20000010"}, {2, "0x20000010"}}) + variable(0x2000, 6, "0") +
           variable(0x1300, 5, "1");
  };
  const Network network = network_of({commissioned(2, srdo("1")), commissioned(3, srdo("2"))});
  NetworkFindings findings(network);
  const Traffic traffic = traffic_of(network, links_of(network), findings);
  for (const auto& expected :
       {std::pair("SRDO 1 transmitted, plain", 0x103U), {"SRDO 1 transmitted, inverse", 0x104U}}) {
    CAPTURE(expected.first);
    const auto message = std::find_if(traffic.messages.begin(), traffic.messages.end(),
                                      [&](const Message& one) { return one.service == expected.first; });
    REQUIRE(message != traffic.messages.end());
    CHECK(message->node == 0);
    CHECK(message->frame.identifier == expected.second);
    CHECK(message->frame.bytes == 2);
    CHECK(message->usual_period == 25000000);
  }
  CHECK(std::none_of(traffic.messages.begin(), traffic.messages.end(),
                     [](const Message& one) { return one.service.find("received") != std::string::npos; }));
  CHECK(found({commissioned(2, srdo("1")), commissioned(3, srdo("2"))}).find("net-cob-id") == std::string::npos);
  CHECK(found({commissioned(2, srdo("1")), commissioned(3, srdo("1"))}).find("net-cob-id: ") != std::string::npos);
}
