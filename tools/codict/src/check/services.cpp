// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>

#include "check/network.hpp"
#include "model/pdo.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

void check_mandatory(const Device& device, Findings& findings) {
  for (const auto& [index, name] :
       {std::pair(0x1000, "Device type"), std::pair(0x1001, "Error register"), std::pair(0x1018, "Identity object")}) {
    if (device.find(static_cast<std::uint16_t>(index)) == nullptr) {
      findings.add(rules::mandatory, {}, fmt::format("mandatory object {:04X}h '{}' is missing", index, name),
                   "describe it");
    }
  }
  const bool has_heartbeat = device.find(0x1017) != nullptr;
  const bool has_guarding = device.find(0x100C) != nullptr && device.find(0x100D) != nullptr;
  if (!has_heartbeat && !has_guarding) {
    findings.add(rules::error_control, {}, "neither heartbeat nor node guarding", "describe 1017h, or 100Ch and 100Dh");
  }
}

// Checks the COB-IDs of the default SDO server. [301: 7.5.2.33]
void check_default_sdo(const Device& device, Findings& findings) {
  struct Identifier {
    std::uint8_t sub_index;
    std::uint16_t base;
    const char* formula;
  };
  for (const Identifier& wanted : {Identifier{1, 0x600, "$NODEID+0x600"}, Identifier{2, 0x580, "$NODEID+0x580"}}) {
    const Entry* const entry = device.find(0x1200, wanted.sub_index);
    if (entry == nullptr || !value_in_force(*entry).is_integer()) {
      continue;
    }
    const Value& value = value_in_force(*entry);
    // The base alone is valid because the device adds its node-ID; in a DCF the value may include the node-ID.
    const Integer with_node = wanted.base + device.commissioning.node_id.value;
    const bool is_of_node = !value.adds_node_id && value.integer == with_node;
    if (value.integer != Integer(wanted.base) && !is_of_node) {
      findings.add(rules::sdo_default, value.span,
                   fmt::format("COB-ID {} is not {:X}h plus the node-ID", text_of(value), wanted.base),
                   fmt::format("write {}", wanted.formula));
    }
  }
}

// Checks the consumer heartbeat times. [301: 7.5.2.19]
void check_consumers(const Device& device, Findings& findings) {
  constexpr unsigned node_shift = 16;
  constexpr std::uint64_t last_node = 127;
  const Object* const consumers = device.find(0x1016);
  if (consumers == nullptr) {
    return;
  }
  std::set<std::uint64_t> nodes;
  for (const Sub& sub : consumers->subs) {
    const Value& value = value_in_force(sub);
    if (sub.sub_index == 0 || !value.is_integer() || value.adds_node_id || value.integer.bits() == 0) {
      continue;
    }
    const std::uint64_t node = value.integer.bits() >> node_shift;
    const bool is_used = (value.integer.bits() & 0xFFFF) != 0;
    if (node > last_node || (node == 0 && is_used)) {
      findings.add(rules::consumer_entry, value.span,
                   fmt::format("{} has node-ID {}, not 1 to 127", text_of(value), node),
                   "write node-ID * 65536 + milliseconds");
    } else if (is_used && node != 0 && !nodes.insert(node).second) {
      findings.add(rules::consumer_twice, value.span, fmt::format("second entry for node {}", node),
                   "remove one of the entries");
    }
  }
}

// Checks the communication cycle period and the synchronous window length. [301: 7.5.2.7]
void check_sync(const Device& device, Findings& findings) {
  const Entry* const cycle = device.find(0x1006, 0);
  const Entry* const window = device.find(0x1007, 0);
  if (cycle == nullptr || window == nullptr) {
    return;
  }
  const Value& cycle_time = value_in_force(*cycle);
  const Value& window_time = value_in_force(*window);
  if (cycle_time.is_integer() && window_time.is_integer() && cycle_time.integer.bits() != 0 &&
      cycle_time.integer < window_time.integer) {
    findings.add(
        rules::sync_window, window_time.span,
        fmt::format("SYNC window {} is longer than the cycle {} in 1006h", text_of(window_time), text_of(cycle_time)),
        "lower 1007h, or raise 1006h");
  }
}

}  // namespace

void check_services(const Device& device, Findings& findings) {
  check_mandatory(device, findings);
  check_default_sdo(device, findings);
  check_consumers(device, findings);
  check_sync(device, findings);
}

}  // namespace lexican::codict::check
