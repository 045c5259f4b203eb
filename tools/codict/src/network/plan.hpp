// SPDX-License-Identifier: Apache-2.0
/// \file plan.hpp
/// Plan of a network: nodes, their descriptions and their configuration. docs/network.md lists its keys.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::network {

/// Value of the plan with its place.
template <typename T>
struct PlanField {
  T value{};
  Span span;
  bool is_given = false;
};

struct PlannedMapping {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  Span span;
};

struct PlannedPdo {
  std::uint16_t number = 1;  ///< 1…512
  Span span;
  PlanField<bool> is_enabled{true, {}, false};
  PlanField<std::uint32_t> cob_id;
  PlanField<std::uint8_t> transmission;
  PlanField<std::uint16_t> inhibit_time;    ///< in 100 us
  PlanField<std::uint16_t> event_timer;     ///< in ms
  PlanField<std::uint16_t> event_deadline;  ///< in ms
  PlanField<std::uint8_t> sync_start;
  PlanField<std::vector<PlannedMapping>> mapping;
};

/// Configured entry; its text is interpreted by its data type.
struct PlannedValue {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string text;
  Span span;
};

using ErrorBehavior = std::vector<std::pair<std::uint8_t, std::uint8_t>>;  // sub-index of 1029h, value

/// Members that master and slaves have in common.
struct PlannedNode {
  std::string name;
  Span span;  ///< place of the name
  PlanField<std::uint8_t> node_id;
  PlanField<std::uint32_t> vendor_id;
  PlanField<std::uint32_t> product_code;
  PlanField<std::uint32_t> revision_number;
  PlanField<std::uint32_t> serial_number;
  PlanField<double> heartbeat_multiplier;
  PlanField<bool> heartbeat_consumer;
  PlanField<std::uint16_t> heartbeat_producer;  ///< in ms
  PlanField<ErrorBehavior> error_behavior;
};

struct PlannedSlave : PlannedNode {
  PlanField<std::string> description;  ///< path of the description, relative to the plan
  PlanField<std::string> dcf_path;
  PlanField<bool> is_booted{true, {}, false};
  PlanField<bool> is_mandatory;
  PlanField<bool> may_reset{true, {}, false};  ///< reset_communication
  PlanField<std::string> software_file;
  PlanField<std::uint32_t> software_version;
  PlanField<std::string> configuration_file;
  PlanField<std::uint8_t> restore_configuration;  ///< sub-index of 1011h
  PlanField<std::uint16_t> guard_time;            ///< in ms
  PlanField<std::uint8_t> life_time_factor;
  std::vector<PlannedPdo> rpdos;
  std::vector<PlannedPdo> tpdos;
  std::vector<PlannedValue> values;
};

/// PDOs that the master receives and transmits beside those of the nodes' links.
enum class Connect : unsigned char {
  all,      ///< receives each TPDO that no node receives, and transmits each RPDO that no node transmits
  planned,  ///< like all, but only the PDOs that the plan contains
  none,
};

struct PlannedMaster : PlannedNode {
  PlanField<std::uint32_t> bit_rate{1000, {}, false};  ///< in kbit/s
  PlanField<std::uint16_t> emcy_inhibit_time;          ///< in 100 us
  PlanField<std::uint32_t> sync_period;                ///< in us
  PlanField<std::uint32_t> sync_window;                ///< in us
  PlanField<std::uint8_t> sync_overflow;
  PlanField<std::uint16_t> nmt_inhibit_time;  ///< in 100 us
  PlanField<bool> start{true, {}, false};
  PlanField<bool> start_nodes{true, {}, false};
  PlanField<bool> start_all_nodes;
  PlanField<bool> reset_all_nodes;
  PlanField<bool> stop_all_nodes;
  PlanField<std::uint32_t> boot_time;  ///< in ms
  PlanField<Connect> connect;
};

struct Plan {
  PlanField<std::string> dcf_path;
  PlanField<double> heartbeat_multiplier{3.0, {}, false};
  PlanField<double> load_limit{70.0, {}, false};  ///< in percent
  PlanField<std::uint32_t> event_interval;        ///< in ms: assumed shortest time between events without another bound
  PlanField<std::string> network_name;
  PlannedMaster master;
  std::vector<PlannedSlave> slaves;
};

/// Reads a plan. Each part that cannot be read is a finding with its place, and is missing in the plan.
Plan read_plan(const Source& source, Findings& findings);

}  // namespace lexican::codict::network
