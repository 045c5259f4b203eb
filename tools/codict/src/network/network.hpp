// SPDX-License-Identifier: Apache-2.0
/// \file network.hpp
/// Nodes of one bus, with what is configured in them.
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
  std::string description;       ///< path of the description; empty for a master that is generated
  std::string configured_files;  ///< of 1F22h: directory and name of the concise DCF
  Span span;                     ///< of its name in the plan

  /// Returns the number that is in force, with the node-ID put in; nothing if there is no such number.
  std::optional<std::uint64_t> number(std::uint16_t index, std::uint8_t sub_index) const;
  std::uint64_t number_or(std::uint16_t index, std::uint8_t sub_index, std::uint64_t other) const {
    return number(index, sub_index).value_or(other);
  }
  /// "drive (node 2)"
  std::string title() const;
  /// COB-IDs of the node. A description that has the base of the default SDO server or of EMCY without $NODEID means
  /// that the device adds its node-ID.
  std::vector<CobId> cob_ids() const;
};

struct Network {
  std::string name;
  bool is_planned = false;              ///< findings have places in the plan, else in the descriptions
  std::uint32_t bit_rate = 0;           ///< in kbit/s; 0: unknown
  double load_limit = 70;               ///< in percent
  std::uint32_t event_interval_ms = 0;  ///< shortest time between events that nothing else bounds; 0: unknown
  std::vector<Node> nodes;              ///< a master that is generated is the last one
};

/// Findings with the source to which their places belong.
class NetworkFindings {
 public:
  explicit NetworkFindings(const Network& network) : network_(network) {}

  /// entry: what is wrong, if it has a value; may be null.
  void add(const Rule& rule, std::size_t node, const Entry* entry, std::string text, std::string hint = {});

  Findings plan;                ///< of a network that is planned
  std::vector<Findings> nodes;  ///< of descriptions, by node

  std::size_t count(Severity severity) const;

 private:
  const Network& network_;
};

/// A PDO that is enabled, and its frame.
struct ActivePdo {
  std::size_t node = 0;
  Pdo pdo;
  std::uint32_t identifier = 0;
  bool is_extended = false;

  std::string title() const;   ///< "TPDO 1"
  std::uint8_t bytes() const;  ///< of its data
  std::uint64_t key() const { return identifier | (is_extended ? 1ULL << 32 : 0); }
};

/// Returns all PDOs of the network whose COB-ID is valid: of each node its RPDOs, then its TPDOs.
std::vector<ActivePdo> active_pdos(const Network& network);

/// "181h", "1ABCDEFh (29 bits)"
std::string cob_id_text(std::uint32_t identifier, bool is_extended);

/// The devices of a plan in the order of plan.slaves, configured as the plan says, and the master.
Network planned_network(const Plan& plan, std::vector<Device> devices, Findings& findings);

/// A DCF or XDC with the name of its node.
struct NamedDevice {
  std::string name;
  std::string path;
  Device device;
};

/// Descriptions that are configured already. bit_rate 0: that of the descriptions.
Network described_network(std::vector<NamedDevice> devices, std::uint32_t bit_rate);

/// Node-IDs and bit rates of the nodes.
void check_nodes(const Network& network, NetworkFindings& findings);

}  // namespace lexican::codict::network
