// SPDX-License-Identifier: Apache-2.0
// Adds the objects of PDOs that an EDS counts but does not describe. [306: 4.5, CompactPDO]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "model/types.hpp"

namespace lexican::codict::eds {

namespace {

constexpr std::uint16_t most_pdos = 512;
constexpr std::uint16_t to_mapping = 0x200;  // offset of a mapping parameter from its communication parameter

struct Direction {
  const char* name;
  std::uint16_t first;   // index of the first communication parameter
  std::uint16_t cob_id;  // COB-ID of the first PDO in the pre-defined connection set
};

struct Parameter {
  const char* name;
  std::uint16_t type;
  std::uint8_t value;
};

// Sub-indexes 1 to 6 of the communication parameters. The COB-ID depends on the PDO.
constexpr std::array<Parameter, 6> parameters = {{{"COB-ID", type_code::unsigned32, 0},
                                                  {"Transmission type", type_code::unsigned8, 255},
                                                  {"Inhibit time", type_code::unsigned16, 0},
                                                  {"Compatibility entry", type_code::unsigned8, 0},
                                                  {"Event timer", type_code::unsigned16, 0},
                                                  {"SYNC start value", type_code::unsigned8, 0}}};

Sub variable(std::uint8_t sub_index, const std::string& name, std::uint16_t type, Access access, std::uint64_t value) {
  Sub sub;
  sub.sub_index = sub_index;
  sub.name.text = name;
  sub.object_code.value = ObjectCode::variable;
  sub.data_type.value = type;
  sub.access.value = access;
  sub.default_value.kind = Value::Kind::integer;
  sub.default_value.integer = value;
  sub.default_value.text = std::to_string(value);
  sub.default_value.is_given = true;
  return sub;
}

Object record(std::uint16_t index, const std::string& name) {
  Object object;
  object.index = index;
  object.name.text = name;
  object.object_code.value = ObjectCode::record;
  object.is_listed = true;
  return object;
}

// Returns the COB-ID of a PDO, which is disabled (bit 31 is set) because it maps no object.
Sub cob_id(const Direction& direction, std::uint16_t number) {
  constexpr std::uint32_t is_off = 0x80000000U;
  constexpr std::uint16_t predefined = 4;
  Sub sub = variable(1, parameters[0].name, parameters[0].type, Access::rw, is_off);
  Value& value = sub.default_value;
  if (number < predefined) {
    value.integer = is_off + direction.cob_id + number * 0x100U;
    value.adds_node_id = true;
  }
  value.text = value.adds_node_id ? value.written_integer() : fmt::format("0x{:08X}", is_off);
  return sub;
}

// Returns a communication parameter. CiA 301 requires sub-indexes 1 and 2, even if the mask excludes them.
Object communication(const Direction& direction, std::uint16_t number, std::uint32_t mask) {
  constexpr std::uint32_t mandatory = 0x3;
  Object object = record(static_cast<std::uint16_t>(direction.first + number),
                         fmt::format("{} communication parameter", direction.name));
  object.subs.push_back(cob_id(direction, number));
  for (std::size_t at = 1; at < parameters.size(); ++at) {
    if ((((mask | mandatory) >> at) & 1U) != 0) {
      const Parameter& parameter = parameters[at];
      object.subs.push_back(
          variable(static_cast<std::uint8_t>(at + 1), parameter.name, parameter.type, Access::rw, parameter.value));
    }
  }
  const std::uint8_t highest = object.subs.back().sub_index;
  object.subs.insert(object.subs.begin(),
                     variable(0, "Highest sub-index supported", type_code::unsigned8, Access::constant, highest));
  return object;
}

// Returns the number of objects that a PDO can map: 64 bits in units of the granularity, or of 8 bits without one.
unsigned entries_of(const Device& device) {
  constexpr unsigned frame_bits = 64;
  const unsigned granularity = device.features.granularity.value;
  return frame_bits / (granularity == 0 || granularity > frame_bits ? 8 : granularity);
}

Object mapping(const Direction& direction, std::uint16_t number, unsigned entries) {
  Object object = record(static_cast<std::uint16_t>(direction.first + to_mapping + number),
                         fmt::format("{} mapping parameter", direction.name));
  object.subs.push_back(variable(0, "Number of mapped objects", type_code::unsigned8, Access::rw, 0));
  for (unsigned entry = 1; entry <= entries; ++entry) {
    object.subs.push_back(variable(static_cast<std::uint8_t>(entry), fmt::format("Mapped object {}", entry),
                                   type_code::unsigned32, Access::rw, 0));
  }
  return object;
}

// Numbers of the PDOs, from 0, whose communication or mapping parameter has no section.
struct MissingParameters {
  std::vector<std::uint16_t> communication;
  std::vector<std::uint16_t> mapping;

  std::size_t objects() const { return communication.size() + mapping.size(); }
};

// Returns the missing parameters of `count` PDOs. PDOs without any parameter get the lowest free numbers.
MissingParameters missing_parameters(const Direction& direction, std::uint16_t count, const Device& device) {
  const auto has = [&](std::uint16_t number, std::uint16_t offset) {
    return device.find(static_cast<std::uint16_t>(direction.first + offset + number)) != nullptr;
  };
  unsigned described = 0;
  for (std::uint16_t number = 0; number < most_pdos; ++number) {
    described += has(number, 0) || has(number, to_mapping) ? 1U : 0U;
  }
  unsigned free = std::max<unsigned>(std::min(count, most_pdos), described) - described;
  MissingParameters missing;
  for (std::uint16_t number = 0; number < most_pdos; ++number) {
    const bool is_described = has(number, 0) || has(number, to_mapping);
    if (!is_described && free == 0) {
      continue;
    }
    free -= is_described ? 0U : 1U;
    if (!has(number, 0)) {
      missing.communication.push_back(number);
    }
    if (!has(number, to_mapping)) {
      missing.mapping.push_back(number);
    }
  }
  return missing;
}

void add_objects(const Direction& direction, std::uint16_t count, const Reader& reader) {
  Device& device = reader.device;
  const Span place = device.features.compact_pdo.span;
  const unsigned entries = entries_of(device);
  const MissingParameters missing = missing_parameters(direction, count, device);
  const std::size_t subs =
      missing.communication.size() * (parameters.size() + 1) + missing.mapping.size() * (entries + 1);
  if (missing.objects() == 0 || !take_implied_subs(subs, place, reader)) {
    return;
  }
  const auto add = [&device, place](Object object) {
    object.span = place;
    for (Sub& sub : object.subs) {
      sub.span = place;
    }
    device.objects.push_back(std::move(object));
  };
  for (const std::uint16_t number : missing.communication) {
    add(communication(direction, number, device.features.compact_pdo.value));
  }
  for (const std::uint16_t number : missing.mapping) {
    add(mapping(direction, number, entries));
  }
  std::sort(device.objects.begin(), device.objects.end(),
            [](const Object& a, const Object& b) { return a.index < b.index; });
  reader.findings.add(rules::compact_pdo, place,
                      fmt::format("{} parameter objects of {}s have no section; CompactPDO implies them, disabled",
                                  missing.objects(), direction.name),
                      "none is needed; codict convert to a DCF writes their sections");
}

}  // namespace

void add_implied_pdos(const Reader& reader) {
  const Features& features = reader.device.features;
  if (features.compact_pdo.value != 0) {
    add_objects({"RPDO", 0x1400, 0x200}, features.rx_pdos.value, reader);
    add_objects({"TPDO", 0x1800, 0x180}, features.tx_pdos.value, reader);
  }
}

}  // namespace lexican::codict::eds
