// SPDX-License-Identifier: Apache-2.0
#include "network/configure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/parse.hpp"
#include "network/master.hpp"
#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

constexpr std::uint64_t largest_base_identifier = 0x7FF;

constexpr std::uint16_t rpdo_communication = 0x1400;
constexpr std::uint16_t tpdo_communication = 0x1800;
constexpr std::uint16_t mapping_offset = 0x200;

void set_number(Value& value, std::uint64_t number, Span span) {
  value = Value();
  value.kind = Value::Kind::integer;
  value.integer = number;
  value.text = fmt::format("0x{:X}", number);
  value.span = span;
  value.is_given = true;
}

template <typename T>
void set_field(Field<T>& field, T value) {
  field.value = value;
  field.text = fmt::format("{}", value);
  field.is_given = true;
}

// Returns the consumer time in ms, rounded up so that it is not shorter than planned.
std::uint64_t consumer_time(std::uint64_t producer_time, double multiplier) {
  constexpr double longest = 65535;
  return static_cast<std::uint64_t>(std::min(std::ceil(static_cast<double>(producer_time) * multiplier), longest));
}

}  // namespace

Entry* Configurator::find(std::uint16_t index, std::uint8_t sub_index, Span span, std::string_view what) {
  Object* const object = node_.device.find(index);
  Entry* entry = object;
  if (object != nullptr && !(object->subs.empty() && sub_index == 0)) {
    entry = object->find(sub_index);
  }
  if (entry == nullptr) {
    findings_.add(rules::object, span,
                  fmt::format("{}: {:04X}h:{} ({}) is not in the description", node_.name, index, sub_index, what),
                  "correct the index, or use the description of this version of the device");
    return nullptr;
  }
  if (!is_writable(entry->access.value)) {
    findings_.add(rules::object, span,
                  fmt::format("{}: {:04X}h:{} ({}) is {}: it cannot be configured", node_.name, index, sub_index, what,
                              name_of(entry->access.value)),
                  "remove it from the plan");
    return nullptr;
  }
  return entry;
}

bool Configurator::set(std::uint16_t index, std::uint8_t sub_index, std::uint64_t value, Span span,
                       std::string_view what) {
  Entry* const entry = find(index, sub_index, span, what);
  if (entry == nullptr) {
    return false;
  }
  const unsigned bits = data_type_of(node_.device, entry->data_type.value).bits;
  if (bits != 0 && !fits_unsigned(value, bits)) {
    findings_.add(rules::object, span,
                  fmt::format("{}: {:04X}h:{} ({}) has {} bits, too few for {:#x}", node_.name, index, sub_index, what,
                              bits, value),
                  fmt::format("write a value of at most {} bits", bits));
    return false;
  }
  set_number(entry->actual_value.edit(), value, span);
  return true;
}

void Configurator::apply(const PlannedSlave& plan) {
  const auto set_planned = [this](const auto& planned, std::uint16_t index, std::string_view what) {
    // A missing object has the same effect as the value 0.
    if (planned.is_given && (planned.value != 0 || node_.device.find(index) != nullptr)) {
      set(index, 0, planned.value, planned.span, what);
    }
  };
  set_planned(plan.heartbeat_producer, 0x1017, "heartbeat_producer");
  set_planned(plan.guard_time, 0x100C, "guard_time");
  set_planned(plan.life_time_factor, 0x100D, "life_time_factor");
  for (const auto& [sub_index, value] : plan.error_behavior.value) {
    set(0x1029, sub_index, value, plan.error_behavior.span, "error_behavior");
  }
  for (const PlannedPdo& pdo : plan.rpdos) {
    apply(pdo, false);
  }
  for (const PlannedPdo& pdo : plan.tpdos) {
    apply(pdo, true);
  }
  for (const PlannedValue& value : plan.values) {
    apply(value);
  }
}

void Configurator::consume_heartbeat(std::uint8_t producer, std::uint64_t time_ms, Span span) {
  const Object* const consumers = node_.device.find(0x1016);
  const std::uint64_t value = std::uint64_t{producer} << 16 | time_ms;
  std::uint8_t free = 0;
  std::uint8_t same = 0;
  for (std::uint8_t sub_index = consumers != nullptr ? highest_sub(*consumers) : std::uint8_t{0}; sub_index != 0;
       --sub_index) {
    const std::uint64_t now = node_.number_or(0x1016, sub_index, 0);
    free = (now & 0xFFFFU) == 0 ? sub_index : free;
    same = now >> 16 == producer && now != 0 ? sub_index : same;
  }
  const std::uint8_t sub_index = same != 0 ? same : free;
  if (sub_index == 0) {
    findings_.add(rules::object, span, fmt::format("{}: no free entry in 1016h (heartbeat_consumer)", node_.name),
                  "remove heartbeat_consumer, or free an entry: sdo, value 0");
    return;
  }
  set(0x1016, sub_index, value, span, "heartbeat_consumer");
}

// PDOs -------------------------------------------------------------------------------------------------------------

void Configurator::apply(const PlannedPdo& plan, bool is_transmit) {
  const std::uint16_t base = is_transmit ? tpdo_communication : rpdo_communication;
  const auto index = static_cast<std::uint16_t>(base + plan.number - 1);
  const std::string what = fmt::format("{}pdo {}", is_transmit ? 't' : 'r', plan.number);
  if (node_.device.find(index) == nullptr) {
    findings_.add(rules::object, plan.span,
                  fmt::format("{} has no {}: there is no {:04X}h in the description", node_.name, what, index),
                  "use a PDO that the description has");
    return;
  }
  apply_cob_id(plan, index, what);
  if (plan.transmission.is_given) {
    set(index, 2, plan.transmission.value, plan.transmission.span, what + " transmission");
  }
  // Sub-index 5 of an RPDO is its deadline. Its inhibit time and event timer configure the TPDO of the master.
  const auto set_time = [&](const auto& planned, std::uint8_t sub_index, std::string_view key) {
    if (planned.is_given) {
      set(index, sub_index, planned.value, planned.span, fmt::format("{} {}", what, key));
    }
  };
  if (is_transmit) {
    set_time(plan.inhibit_time, 3, "inhibit_time");
    set_time(plan.event_timer, 5, "event_timer");
    set_time(plan.sync_start, 6, "sync_start");
  } else {
    set_time(plan.event_deadline, 5, "event_deadline");
  }
  if (plan.mapping.is_given) {
    apply_mapping(plan, is_transmit, what);
  }
}

void Configurator::apply_cob_id(const PlannedPdo& plan, std::uint16_t index, const std::string& what) {
  const std::optional<std::uint64_t> described = node_.number(index, 1);
  std::uint64_t cob_id = described.value_or(cob_id_invalid) & ~cob_id_invalid;
  Span span = plan.span;
  if (plan.cob_id.is_given) {
    const bool is_extended = plan.cob_id.value > largest_base_identifier;
    cob_id = plan.cob_id.value | (is_extended ? cob_id_extended : 0) | (cob_id & 0x40000000U);  // bit 30: no RTR
    span = plan.cob_id.span;
  } else if (plan.is_enabled.value && (cob_id & 0x1FFFFFFFU) == 0) {
    findings_.add(rules::missing, plan.span, fmt::format("{}: {} has no COB-ID", node_.name, what),
                  "add a free one: cob_id: 0x181");
    return;
  }
  if (!plan.is_enabled.value) {
    cob_id |= cob_id_invalid;
  }
  // A constant COB-ID that already has the planned value needs no configuration.
  const Entry* const entry = node_.device.find(index, 1);
  if (described != cob_id || (entry != nullptr && is_writable(entry->access.value))) {
    set(index, 1, cob_id, span, what + " cob_id");
  }
}

unsigned Configurator::mapped_bits(const PlannedMapping& mapped, bool is_transmit, const std::string& what) {
  const std::string object = fmt::format("{:04X}h:{}", mapped.index, mapped.sub_index);
  const auto refuse = [&](std::string_view why) {
    findings_.add(rules::mapping, mapped.span, fmt::format("{}: {} maps {}, {}", node_.name, what, object, why),
                  "map another object");
    return 0U;
  };
  if (mapped.index < 0x20 && mapped.sub_index == 0) {  // dummy object
    const unsigned bits = data_type(mapped.index).bits;
    return is_transmit ? refuse("a dummy, which only RPDOs may map") : bits != 0 ? bits : refuse("which is no dummy");
  }
  const Entry* const entry = node_.device.find(mapped.index, mapped.sub_index);
  if (entry == nullptr) {
    return refuse("which is not in the description");
  }
  const Directions directions = directions_of(*entry);
  if (is_transmit ? !directions.send : !directions.receive) {
    return refuse(fmt::format("which cannot be mapped in {} (access {})", is_transmit ? "a TPDO" : "an RPDO",
                              name_of(entry->access.value)));
  }
  const unsigned bits = data_type_of(node_.device, entry->data_type.value).bits;
  return bits != 0 ? bits : refuse("whose data type has no fixed length");
}

void Configurator::apply_mapping(const PlannedPdo& plan, bool is_transmit, const std::string& what) {
  const std::uint16_t base = is_transmit ? tpdo_communication : rpdo_communication;
  const auto index = static_cast<std::uint16_t>(base + mapping_offset + plan.number - 1);
  unsigned sum = 0;
  std::uint8_t count = 0;
  for (const PlannedMapping& mapped : plan.mapping.value) {
    const unsigned bits = mapped_bits(mapped, is_transmit, what);
    const std::uint64_t value = std::uint64_t{mapped.index} << 16 | std::uint64_t{mapped.sub_index} << 8 | bits;
    if (bits == 0 || !set(index, ++count, value, mapped.span, what + " mapping")) {
      return;
    }
    sum += bits;
  }
  if (sum > 64) {
    findings_.add(rules::mapping, plan.mapping.span,
                  fmt::format("{}: {} maps {} bits, a frame has 64", node_.name, what, sum),
                  "map fewer or shorter objects");
  }
  set(index, 0, count, plan.mapping.span, what + " mapping");
}

void Configurator::apply(const PlannedValue& plan) {
  Entry* const entry = find(plan.index, plan.sub_index, plan.span, "sdo");
  if (entry == nullptr) {
    return;
  }
  Value value;
  value.text = plan.text;
  value.span = plan.span;
  value.is_given = true;
  interpret(value, data_type_of(node_.device, entry->data_type.value), findings_);
  if (value.kind != Value::Kind::malformed) {
    entry->actual_value = std::move(value);
  }
}

// The whole network ------------------------------------------------------------------------------------------------

namespace {

Node slave_of(const Plan& plan, const PlannedSlave& planned, Device device, Findings& findings) {
  Node node;
  node.name = planned.name;
  node.span = planned.span;
  node.description = planned.description.value;
  node.device = std::move(device);
  Commissioning& commissioning = node.device.commissioning;
  node.node_id = planned.node_id.is_given             ? planned.node_id.value
                 : commissioning.node_id.value <= 127 ? commissioning.node_id.value
                                                      : std::uint8_t{0};
  commissioning.is_given = true;
  commissioning.is_manager = {};
  set_field(commissioning.node_id, node.node_id);
  set_field(commissioning.bit_rate, plan.master.bit_rate.value);
  commissioning.node_name.text = planned.name;
  commissioning.node_name.is_given = true;
  if (planned.serial_number.is_given) {
    set_field(commissioning.serial_number, planned.serial_number.value);
  }
  std::string directory = planned.dcf_path.is_given ? planned.dcf_path.value : plan.dcf_path.value;
  directory += directory.empty() || directory.back() == '/' ? "" : "/";
  node.configured_files =
      planned.configuration_file.is_given ? planned.configuration_file.value : directory + planned.name + ".bin";
  Configurator(node, findings).apply(planned);
  return node;
}

double multiplier_of(const Plan& plan, const PlannedNode& node) {
  return node.heartbeat_multiplier.is_given ? node.heartbeat_multiplier.value : plan.heartbeat_multiplier.value;
}

void monitor_master(const Plan& plan, const PlannedSlave& planned, Node& node, Findings& findings) {
  const std::uint64_t time = plan.master.heartbeat_producer.value;
  if (time == 0) {
    findings.add(rules::heartbeat_producer, planned.heartbeat_consumer.span,
                 fmt::format("{} monitors the master, which produces no heartbeat", planned.name),
                 "set heartbeat_producer of the master");
    return;
  }
  Configurator(node, findings)
      .consume_heartbeat(plan.master.node_id.value, consumer_time(time, multiplier_of(plan, plan.master)),
                         planned.heartbeat_consumer.span);
}

}  // namespace

Network planned_network(const Plan& plan, std::vector<Device> devices, Findings& findings) {
  Network network;
  network.is_planned = true;
  network.name = plan.network_name.value;
  network.bit_rate = plan.master.bit_rate.value;
  network.load_limit = plan.load_limit.value;
  network.event_interval_ms = plan.event_interval.value;
  std::vector<std::uint64_t> consumer_times;
  for (std::size_t n = 0; n < plan.slaves.size(); ++n) {
    const PlannedSlave& planned = plan.slaves[n];
    Node node = slave_of(plan, planned, std::move(devices[n]), findings);
    if (planned.heartbeat_consumer.value) {
      monitor_master(plan, planned, node, findings);
    }
    consumer_times.push_back(consumer_time(node.number_or(0x1017, 0, 0), multiplier_of(plan, planned)));
    network.nodes.push_back(std::move(node));
  }
  if (plan.master.node_id.is_given) {
    network.nodes.push_back(generated_master(plan, network, consumer_times, findings));
  }
  return network;
}

}  // namespace lexican::codict::network
