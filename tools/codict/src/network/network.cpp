// SPDX-License-Identifier: Apache-2.0
#include "network/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

void check_bit_rate(const Network& network, std::size_t at, NetworkFindings& findings) {
  const Node& node = network.nodes[at];
  const std::uint32_t own = node.device.commissioning.bit_rate.value;
  if (own != 0 && own != network.bit_rate) {
    findings.add(
        rules::bit_rate, at, nullptr,
        fmt::format("{} is configured for {} kbit/s, the network has {} kbit/s", node.title(), own, network.bit_rate),
        "give all nodes one bit rate");
  }
  const std::vector<BitRate>& rates = node.device.features.bit_rates;
  const auto rate = std::find_if(rates.begin(), rates.end(),
                                 [&network](const BitRate& each) { return each.kbit == network.bit_rate; });
  const bool is_any = std::any_of(rates.begin(), rates.end(), [](const BitRate& each) { return each.supported.value; });
  if (is_any && (rate == rates.end() || !rate->supported.value)) {
    findings.add(rules::bit_rate, at, nullptr,
                 fmt::format("{} does not support {} kbit/s", node.title(), network.bit_rate),
                 "choose a bit rate that all descriptions have");
  }
}

}  // namespace

std::optional<std::uint64_t> Node::number(std::uint16_t index, std::uint8_t sub_index) const {
  const Entry* const entry = device.find(index, sub_index);
  if (entry == nullptr || !value_in_force(*entry).is_integer()) {
    return std::nullopt;
  }
  return value_in_force(*entry).integer_for(node_id).bits();
}

std::string Node::title() const { return node_id == 0 ? name : fmt::format("{} (node {})", name, node_id); }

std::vector<CobId> Node::cob_ids() const {
  std::vector<CobId> all = cob_ids_of(device, node_id);
  for (CobId& cob_id : all) {
    const bool is_sdo_base = cob_id.index == 0x1200 && (cob_id.value == 0x600 || cob_id.value == 0x580);
    const bool is_emcy_base = cob_id.index == 0x1014 && cob_id.value == 0x80;
    cob_id.value += is_sdo_base || is_emcy_base ? node_id : 0U;
  }
  return all;
}

void NetworkFindings::add(const Rule& rule, std::size_t node, const Entry* entry, std::string text, std::string hint) {
  if (network_.is_planned) {
    plan.add(rule, network_.nodes[node].span, std::move(text), std::move(hint));
    return;
  }
  nodes.resize(network_.nodes.size());
  const Value* const value = entry != nullptr ? &value_in_force(*entry) : nullptr;
  const Span span = value == nullptr ? Span() : value->is_given ? value->span : entry->span;
  nodes[node].add(rule, span, std::move(text), std::move(hint));
}

std::size_t NetworkFindings::count(Severity severity) const {
  std::size_t sum = plan.count(severity);
  for (const Findings& findings : nodes) {
    sum += findings.count(severity);
  }
  return sum;
}

std::string ActivePdo::title() const { return fmt::format("{}PDO {}", pdo.is_transmit ? 'T' : 'R', pdo.number); }

std::uint8_t ActivePdo::bytes() const {
  constexpr unsigned most = 8;
  return static_cast<std::uint8_t>(pdo.is_multiplexed ? most : std::min((pdo.bits() + 7) / 8, most));
}

std::vector<ActivePdo> active_pdos(const Network& network) {
  std::vector<ActivePdo> active;
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const Node& node = network.nodes[n];
    for (const Pdo& pdo : pdos_of(node.device)) {
      const std::optional<std::uint64_t> cob_id =
          pdo.communication != nullptr ? node.number(pdo.communication->index, 1) : std::nullopt;
      if (cob_id && (*cob_id & cob_id_invalid) == 0) {
        const bool is_extended = (*cob_id & cob_id_extended) != 0;
        const std::uint64_t mask = is_extended ? 0x1FFFFFFFU : 0x7FFU;
        active.push_back({n, pdo, static_cast<std::uint32_t>(*cob_id & mask), is_extended});
      }
    }
  }
  return active;
}

std::string cob_id_text(std::uint32_t identifier, bool is_extended) {
  return is_extended ? fmt::format("{:X}h (29 bits)", identifier) : fmt::format("{:03X}h", identifier);
}

Network described_network(std::vector<NamedDevice> devices, std::uint32_t bit_rate) {
  Network network;
  network.bit_rate = bit_rate;
  for (NamedDevice& named : devices) {
    Node node;
    const Commissioning& commissioning = named.device.commissioning;
    node.name = std::move(named.name);
    node.description = std::move(named.path);
    node.node_id = commissioning.node_id.value <= 127 ? commissioning.node_id.value : std::uint8_t{0};
    node.is_master = commissioning.is_manager.value;
    network.bit_rate = network.bit_rate == 0 ? commissioning.bit_rate.value : network.bit_rate;
    network.name = network.name.empty() ? commissioning.network_name.text : network.name;
    node.device = std::move(named.device);
    network.nodes.push_back(std::move(node));
  }
  return network;
}

void check_nodes(const Network& network, NetworkFindings& findings) {
  std::map<std::uint8_t, std::size_t> seen;
  for (std::size_t n = 0; n < network.nodes.size(); ++n) {
    const Node& node = network.nodes[n];
    if (node.node_id == 0) {
      findings.add(rules::node_id, n, nullptr, fmt::format("{} has no node-ID", node.name),
                   "set it in the plan (node_id: 1…127) or in [DeviceComissioning] of a DCF");
    } else if (const auto [place, is_new] = seen.emplace(node.node_id, n); !is_new) {
      findings.add(
          rules::node_id, n, nullptr,
          fmt::format("{} and {} have the node-ID {}", network.nodes[place->second].name, node.name, node.node_id),
          "give one of them another node-ID");
    }
    if (network.bit_rate != 0) {
      check_bit_rate(network, n, findings);
    }
  }
}

}  // namespace lexican::codict::network
