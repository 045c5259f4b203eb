// SPDX-License-Identifier: Apache-2.0
/// \file configure.hpp
/// Values that a plan configures in a device.
#pragma once

#include <cstdint>
#include <string>

#include "network/network.hpp"
#include "network/plan.hpp"
#include "text/finding.hpp"

namespace lexican::codict::network {

class Configurator {
 public:
  Configurator(Node& node, Findings& findings) : node_(node), findings_(findings) {}

  /// Configures a number. Adds a finding if the description has no such entry, or one that cannot be written. what: for
  /// messages.
  bool set(std::uint16_t index, std::uint8_t sub_index, std::uint64_t value, Span span, std::string_view what);

  /// Configures everything that the plan contains for a node, except for its heartbeat consumer.
  void apply(const PlannedSlave& plan);

  /// Configures an entry of 1016h: the one of this producer, else the first free one.
  void consume_heartbeat(std::uint8_t producer, std::uint64_t time_ms, Span span);

 private:
  Entry* find(std::uint16_t index, std::uint8_t sub_index, Span span, std::string_view what);
  void apply(const PlannedPdo& plan, bool is_transmit);
  void apply_cob_id(const PlannedPdo& plan, std::uint16_t index, const std::string& what);
  void apply_mapping(const PlannedPdo& plan, bool is_transmit, const std::string& what);
  unsigned mapped_bits(const PlannedMapping& mapped, bool is_transmit, const std::string& what);
  void apply(const PlannedValue& plan);

  Node& node_;
  Findings& findings_;
};

}  // namespace lexican::codict::network
