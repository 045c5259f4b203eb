// SPDX-License-Identifier: Apache-2.0
// Fuzzes plans of networks with any bytes: all positions that are reported are within the plan, and the DCFs and
// concise DCFs that are written are read back as the same network. A line "# description" ends the plan: the bytes
// behind it are the description of all nodes, which is otherwise that of a synthetic drive.
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "eds/document.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "fuzz/fuzz.hpp"
#include "network/check.hpp"
#include "network/links.hpp"
#include "network/network.hpp"
#include "network/plan.hpp"
#include "network/report.hpp"
#include "network/traffic.hpp"

namespace {

using namespace lexican::codict;
using network::Network;

using fuzz::require;

// Returns the devices of a description: none if the reader refuses it.
std::vector<Device> devices_of(const std::string& bytes) {
  const Source source("fuzz.eds", bytes);
  if (!eds::refusal(source).empty()) {
    return {};
  }
  Findings findings;
  const eds::Document document(source, findings);
  return eds::refusal(document).empty() ? eds::read(document, findings).devices : std::vector<Device>();
}

const std::vector<Device>& drive() {
  static const std::vector<Device> devices = [] {
    std::ifstream file(LEXICAN_FUZZ_DESCRIPTION, std::ios::binary);
    return devices_of({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
  }();
  require(!devices.empty(), "the description of the drive is read");
  return devices;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, unsigned size) {
  std::uint32_t number = 0;
  for (unsigned n = 0; n < size; ++n) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + n])) << (8 * n);
  }
  return number;
}

// Checks the lengths in a concise DCF.
void require_concise(const std::string& bytes) {
  constexpr std::size_t header = 7;  // index, sub-index, length
  require(bytes.size() >= 4, "a concise DCF begins with the number of its entries");
  std::size_t at = 4;
  for (std::uint32_t entries = number_at(bytes, 0, 4); entries != 0; --entries) {
    require(bytes.size() - at >= header, "a concise DCF has all of its entries");
    const std::uint32_t length = number_at(bytes, at + 3, 4);
    at += header;
    require(bytes.size() - at >= length, "a concise DCF has all of a value");
    at += length;
  }
  require(at == bytes.size(), "nothing follows the entries of a concise DCF");
}

// Checks the files of a network: the DCFs describe the same nodes and PDO links.
void require_files(const Network& network, const network::Links& links, const std::vector<network::File>& files) {
  std::vector<network::NamedDevice> devices;
  for (const network::File& file : files) {
    if (file.name.substr(file.name.size() - 4) == ".bin") {
      require_concise(file.bytes);
      continue;
    }
    std::vector<Device> read = devices_of(file.bytes);
    require(read.size() == 1, "a DCF is read");
    devices.push_back({file.name, file.name, std::move(read.front())});
  }
  require(devices.size() == network.nodes.size(), "each node has a DCF");
  const Network again = network::described_network(std::move(devices), network.bit_rate);
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    require(again.nodes[n].node_id == network.nodes[n].node_id, "a node-ID is kept");
    require(again.nodes[n].is_master == network.nodes[n].is_master, "the master is kept");
  }
  require(network::links_of(again).links.size() == links.links.size(), "PDO links are kept");
}

void check_findings(const Findings& findings, std::size_t size) {
  for (const Finding& finding : findings.all()) {
    require(finding.span.begin <= finding.span.end && finding.span.end <= size, "findings are in the plan");
  }
}

void run(const std::string& yaml, const Device& device) {
  const Source source("plan.yaml", yaml);
  Findings findings;
  const network::Plan plan = network::read_plan(source, findings);
  check_findings(findings, yaml.size());
  if (findings.count(Severity::error) != 0) {
    return;
  }
  const Network net = network::planned_network(plan, std::vector<Device>(plan.slaves.size(), device), findings);
  network::NetworkFindings all(net);
  all.plan = findings;
  const network::Links links = network::links_of(net);
  network::check_all(net, links, all);
  const network::Traffic traffic = network::traffic_of(net, links, all);
  require_files(net, links, network::configuration_files(net, all));
  network::html_report(net, links, traffic, all);
  check_findings(all.plan, yaml.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string separator = "# description\n";
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find(separator);
  const std::vector<Device> own =
      end == std::string::npos ? std::vector<Device>() : devices_of(input.substr(end + separator.size()));
  run(input.substr(0, end), own.empty() ? drive().front() : own.front());
  return 0;
}
