// SPDX-License-Identifier: Apache-2.0
#include "model/pdo.hpp"

#include <algorithm>
#include <cstdint>

namespace lexican::codict {

namespace {

constexpr std::uint16_t pdo_limit = 512;
constexpr std::uint64_t mapped_limit = 64;

// Returns the number of mapped objects: the value of sub-index 0, else the highest described sub-index.
std::uint64_t mapped_count(const Object& mapping) {
  const Sub* const number = mapping.find(0);
  const bool is_said = number != nullptr && value_in_force(*number).is_integer();
  return is_said ? value_in_force(*number).integer.bits() : highest_sub(mapping);
}

void read_mapping(const Device& device, Pdo& pdo) {
  const std::uint64_t count = mapped_count(*pdo.mapping);
  pdo.is_multiplexed = count == 0xFE || count == 0xFF;
  if (!pdo.is_multiplexed) {
    pdo.mapped = mapped_objects(device, *pdo.mapping, mapped_limit);
  }
}

void add_pdos(const Device& device, std::uint16_t first, bool is_transmit, std::vector<Pdo>& pdos) {
  for (std::uint16_t at = 0; at < pdo_limit; ++at) {
    Pdo pdo;
    pdo.is_transmit = is_transmit;
    pdo.number = static_cast<std::uint16_t>(at + 1);
    pdo.communication = device.find(static_cast<std::uint16_t>(first + at));
    pdo.mapping = device.find(static_cast<std::uint16_t>(first + 0x200 + at));
    if (pdo.mapping != nullptr) {
      read_mapping(device, pdo);
    }
    if (pdo.mapping != nullptr || pdo.communication != nullptr) {
      pdos.push_back(pdo);
    }
  }
}

}  // namespace

Directions directions_of(const Entry& entry) {
  const Access access = entry.access.value;
  const PdoMapping mapping = entry.pdo_mapping.value;
  const bool is_mappable = mapping != PdoMapping::no;
  Directions directions;
  directions.send = is_mappable && is_readable(access) && mapping != PdoMapping::rpdo && access != Access::rww;
  directions.receive = is_mappable && is_writable(access) && mapping != PdoMapping::tpdo && access != Access::rwr;
  return directions;
}

std::vector<MappedObject> mapped_objects(const Device& device, const Object& mapping, std::uint64_t limit) {
  const std::uint64_t count = std::min(mapped_count(mapping), limit);
  std::vector<MappedObject> all;
  for (const Sub& sub : mapping.subs) {
    const Value& value = value_in_force(sub);
    if (sub.sub_index == 0 || sub.sub_index > count || !value.is_integer() || value.integer.bits() == 0) {
      continue;
    }
    const auto map = static_cast<std::uint32_t>(value.integer.bits());
    MappedObject mapped;
    mapped.index = static_cast<std::uint16_t>(map >> 16);
    mapped.sub_index = static_cast<std::uint8_t>(map >> 8);
    mapped.bits = static_cast<std::uint8_t>(map);
    mapped.mapping = &sub;
    mapped.entry = mapped.is_dummy() ? nullptr : device.find(mapped.index, mapped.sub_index);
    all.push_back(mapped);
  }
  return all;
}

unsigned Pdo::bits() const {
  unsigned sum = 0;
  for (const MappedObject& object : mapped) {
    sum += object.bits;
  }
  return sum;
}

const Entry* Pdo::parameter(std::uint8_t sub_index) const {
  return communication != nullptr ? communication->find(sub_index) : nullptr;
}

std::vector<Pdo> pdos_of(const Device& device) {
  std::vector<Pdo> pdos;
  add_pdos(device, 0x1400, false, pdos);
  add_pdos(device, 0x1800, true, pdos);
  return pdos;
}

}  // namespace lexican::codict
