// SPDX-License-Identifier: Apache-2.0
/// \file network.hpp
/// Nodes of one bus with their configuration.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/cob_id.hpp"
#include "model/device.hpp"
#include "model/pdo.hpp"
#include "network/plan.hpp"
#include "text/finding.hpp"

namespace lexican::codict::network {

struct Node {
  std::string name;
  std::uint8_t node_id = 0;  ///< 0: unknown
  bool is_master = false;
  Device device;
  std::string description;       ///< path of the description; empty for a generated master
  std::string configured_files;  ///< for 1F22h: directory and name of the concise DCF
  Span span;                     ///< place of the node's name in the plan

  /// Returns the configured or default value, with the node-ID added; nothing if there is no such number.
  std::optional<std::uint64_t> number(std::uint16_t index, std::uint8_t sub_index) const;
  std::uint64_t number_or(std::uint16_t index, std::uint8_t sub_index, std::uint64_t other) const {
    return number(index, sub_index).value_or(other);
  }
  /// Returns "drive (node 2)".
  std::string title() const;
  /// Returns the COB-IDs of the node. If a description has the base of a default SDO server's or EMCY COB-ID without
  /// $NODEID, the device adds its node-ID.
  std::vector<CobId> cob_ids() const;
};

struct Network {
  std::string name;
  bool is_planned = false;              ///< findings refer to places in the plan, else in the descriptions
  std::uint32_t bit_rate = 0;           ///< in kbit/s; 0: unknown
  double load_limit = 70;               ///< in percent
  std::uint32_t event_interval_ms = 0;  ///< assumed shortest time between events without another bound; 0: unknown
  std::vector<Node> nodes;              ///< all nodes; a generated master is the last one
};

/// Findings, grouped by the source to which their places belong.
class NetworkFindings {
 public:
  explicit NetworkFindings(const Network& network) : network_(network) {}

  /// Adds a finding. entry: the faulty entry if it has a value; may be null.
  void add(const Rule& rule, std::size_t node, const Entry* entry, std::string text, std::string hint = {});

  Findings plan;                ///< findings of a planned network
  std::vector<Findings> nodes;  ///< findings of descriptions, by node

  std::size_t count(Severity severity) const;

 private:
  const Network& network_;
};

/// Enabled PDO and its COB-ID.
struct ActivePdo {
  std::size_t node = 0;
  Pdo pdo;
  std::uint32_t identifier = 0;
  bool is_extended = false;

  std::string title() const;   ///< "TPDO 1"
  std::uint8_t bytes() const;  ///< length of the data
  std::uint64_t key() const { return identifier | (is_extended ? 1ULL << 32 : 0); }
};

/// Returns all PDOs of the network whose COB-ID is valid: of each node its RPDOs, then its TPDOs.
std::vector<ActivePdo> active_pdos(const Network& network);

/// Returns "181h" or "1ABCDEFh (29 bits)".
std::string cob_id_text(std::uint32_t identifier, bool is_extended);

/// Returns the network of a plan: the devices in the order of plan.slaves, configured, and the master.
Network planned_network(const Plan& plan, std::vector<Device> devices, Findings& findings);

/// DCF or XDC with the name of its node.
struct NamedDevice {
  std::string name;
  std::string path;
  Device device;
};

/// Returns the network of devices that are already configured. bit_rate 0: taken from the descriptions.
Network described_network(std::vector<NamedDevice> devices, std::uint32_t bit_rate);

/// Checks node-IDs and bit rates of the nodes.
void check_nodes(const Network& network, NetworkFindings& findings);

}  // namespace lexican::codict::network
