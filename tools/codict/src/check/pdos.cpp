// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/network.hpp"
#include "model/pdo.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

constexpr std::uint64_t mapped_limit = 64;
constexpr unsigned frame_bits = 64;

std::string title_of(const Pdo& pdo) { return (pdo.is_transmit ? "TPDO " : "RPDO ") + std::to_string(pdo.number); }

void check_pair(const Device& device, const Pdo& pdo, Findings& findings) {
  const bool is_implicit = device.features.compact_pdo.value != 0;
  if (pdo.mapping == nullptr && !is_implicit) {
    findings.add(rules::pdo_pair, pdo.communication->span, title_of(pdo) + " has no mapping parameter",
                 fmt::format("describe {:04X}h", pdo.communication->index + 0x200));
  }
  if (pdo.communication == nullptr && !is_implicit) {
    findings.add(rules::pdo_pair, pdo.mapping->span, title_of(pdo) + " has no communication parameter",
                 fmt::format("describe {:04X}h", pdo.mapping->index - 0x200));
  }
}

// Mapping ----------------------------------------------------------------------------------------------------------

void check_number(const Pdo& pdo, Findings& findings) {
  const Sub* const zero = pdo.mapping->find(0);
  if (zero == nullptr || !value_in_force(*zero).is_integer()) {
    return;
  }
  const Value& value = value_in_force(*zero);
  const Span place = value.is_given ? value.span : zero->span;
  const std::uint64_t number = value.integer.bits();
  if (number > mapped_limit && number != 0xFE && number != 0xFF) {
    findings.add(rules::pdo_mapped_count, place, fmt::format("{} is not a number of mapped objects", number),
                 "write 0 to 64, or 254 or 255 for a multiplexed PDO");
  } else if (!pdo.is_multiplexed && number != pdo.mapped.size()) {
    findings.add(rules::pdo_gap, place,
                 fmt::format("sub-index 0 is {}, but the number of mapped objects is {}", number, pdo.mapped.size()),
                 "correct sub-index 0, or map the missing objects");
  }
}

// Reports an enabled PDO without mapped objects: some devices transmit empty frames, others reject the configuration.
void check_empty(const Pdo& pdo, Findings& findings) {
  constexpr std::uint64_t off = 0x80000000U;
  const Entry* const cob_id = pdo.parameter(1);
  const Sub* const zero = pdo.mapping->find(0);
  const bool is_on =
      cob_id != nullptr && value_in_force(*cob_id).is_integer() && (value_in_force(*cob_id).integer.bits() & off) == 0;
  const bool has_number = zero != nullptr && value_in_force(*zero).is_integer();
  const bool has_gap = has_number && value_in_force(*zero).integer.bits() != 0;
  if (is_on && pdo.mapped.empty() && !pdo.is_multiplexed && !has_gap) {
    findings.add(rules::pdo_empty, value_in_force(*cob_id).span,
                 title_of(pdo) + " has a valid COB-ID, but maps no object",
                 "map an object, or set bit 31 of the COB-ID");
  }
}

bool takes_dummy(const Device& device, std::uint16_t type) {
  return std::any_of(device.dummies.begin(), device.dummies.end(),
                     [type](const Dummy& dummy) { return dummy.type == type && dummy.supported.value; });
}

void check_dummy(const Device& device, const Pdo& pdo, const MappedObject& mapped, Span span, Findings& findings) {
  if (pdo.is_transmit) {
    findings.add(rules::pdo_dummy, span, "dummy mapping in a TPDO", "map an object of the device");
  } else if (!takes_dummy(device, mapped.index)) {
    findings.add(rules::pdo_dummy, span,
                 fmt::format("dummy mapping of {}, which the device does not support", type_text(mapped.index)),
                 fmt::format("set Dummy{:04X}=1 in [DummyUsage]", mapped.index));
  }
}

std::string name_of(const Device& device, const MappedObject& mapped) {
  return subject_of(device, mapped.index, mapped.sub_index);
}

void check_bits(const Device& device, const MappedObject& mapped, Span span, Findings& findings) {
  const unsigned bits = data_type_of(device, mapped.entry->data_type.value).bits;
  if (bits == 0) {
    return;  // the data type of a string has no length
  }
  const std::string text = fmt::format("mapping of {} bits, but {} has {}", mapped.bits, name_of(device, mapped), bits);
  const std::string hint = fmt::format("write {:04X}{:02X}{:02X}h", mapped.index, mapped.sub_index, bits);
  // A BOOLEAN may be mapped with 8 bits. [301: 7.4.7.1]
  if (mapped.bits > std::max(bits, 8U)) {
    findings.add(rules::pdo_bits, span, text, hint);
  } else if (mapped.bits < bits) {
    findings.add(rules::pdo_part, span, text, hint);
  }
}

void check_mapped(const Device& device, const Pdo& pdo, const MappedObject& mapped, Findings& findings) {
  const Span span = value_in_force(*mapped.mapping).span;
  if (mapped.is_dummy()) {
    check_dummy(device, pdo, mapped, span, findings);
  } else if (mapped.entry == nullptr) {
    findings.add(rules::pdo_object, span, fmt::format("mapped object {} does not exist", name_of(device, mapped)),
                 "describe the object, or correct the mapping");
  } else {
    const Directions directions = directions_of(*mapped.entry);
    if (!(pdo.is_transmit ? directions.send : directions.receive)) {
      findings.add(rules::pdo_access, span,
                   fmt::format("{} maps {} (access {}, PDO mapping {})", title_of(pdo), name_of(device, mapped),
                               name_of(mapped.entry->access.value), name_of(mapped.entry->pdo_mapping.value)),
                   "correct AccessType or PDOMapping of the object");
    }
    check_bits(device, mapped, span, findings);
  }
  const std::uint8_t granularity = device.features.granularity.value;
  if (granularity != 0 && mapped.bits % granularity != 0) {
    findings.add(rules::pdo_granularity, span,
                 fmt::format("mapped length {} is not a multiple of the granularity {}", mapped.bits, granularity),
                 "correct Granularity, or map a longer object");
  }
}

void check_mapping(const Device& device, const Pdo& pdo, Findings& findings) {
  check_number(pdo, findings);
  check_empty(pdo, findings);
  for (const MappedObject& mapped : pdo.mapped) {
    check_mapped(device, pdo, mapped, findings);
  }
  if (pdo.bits() > frame_bits) {
    findings.add(rules::pdo_length, pdo.mapping->span,
                 fmt::format("{} has {} bits, more than {}", title_of(pdo), pdo.bits(), frame_bits),
                 "map fewer or shorter objects");
  }
}

// Communication parameters -----------------------------------------------------------------------------------------

bool is_type(std::uint64_t type, bool is_transmit) {
  const bool is_remote = type == transmission_type::remote_synchronous || type == transmission_type::remote;
  return type <= transmission_type::last_synchronous || type == transmission_type::event_manufacturer ||
         type == transmission_type::event_profile || (is_remote && is_transmit);
}

void check_time(const Pdo& pdo, std::uint8_t sub_index, const char* what, Findings& findings) {
  const Entry* const time = pdo.parameter(sub_index);
  if (time != nullptr && value_in_force(*time).is_integer() && value_in_force(*time).integer.bits() != 0) {
    findings.add(rules::pdo_time, value_in_force(*time).span,
                 fmt::format("{} {} has no effect without events", what, text_of(value_in_force(*time))),
                 "write 0, or use transmission type 254 or 255");
  }
}

void check_communication(const Pdo& pdo, Findings& findings) {
  constexpr std::uint8_t type_sub = 2;
  constexpr std::uint8_t inhibit_sub = 3;
  constexpr std::uint8_t event_sub = 5;
  const Entry* const type = pdo.parameter(type_sub);
  if (type == nullptr || !value_in_force(*type).is_integer()) {
    return;
  }
  const std::uint64_t number = value_in_force(*type).integer.bits();
  if (!is_type(number, pdo.is_transmit)) {
    findings.add(rules::pdo_type, value_in_force(*type).span,
                 fmt::format("{} has invalid transmission type {}", title_of(pdo), number),
                 pdo.is_transmit ? "write 0 to 240, 252 to 255" : "write 0 to 240, 254 or 255");
  } else if (pdo.is_transmit && number != transmission_type::event_manufacturer &&
             number != transmission_type::event_profile) {
    check_time(pdo, inhibit_sub, "inhibit time", findings);
    check_time(pdo, event_sub, "event time", findings);
  }
}

// Returns true if the PDO is enabled and synchronous in the described configuration.
bool is_synchronous(const Pdo& pdo) {
  constexpr std::uint64_t is_off = 0x80000000U;
  const Entry* const cob_id = pdo.parameter(1);
  const Entry* const type = pdo.parameter(2);
  if (cob_id == nullptr || type == nullptr || !value_in_force(*cob_id).is_integer() ||
      !value_in_force(*type).is_integer()) {
    return false;
  }
  const std::uint64_t number = value_in_force(*type).integer.bits();
  const bool has_type = number <= transmission_type::last_synchronous ||
                        (number == transmission_type::remote_synchronous && pdo.is_transmit);
  return has_type && (value_in_force(*cob_id).integer.bits() & is_off) == 0;
}

// Reports the first PDO only, because one missing object is the cause for all.
void check_sync(const Device& device, const std::vector<Pdo>& pdos, Findings& findings) {
  const auto pdo = std::find_if(pdos.begin(), pdos.end(), is_synchronous);
  if (pdo != pdos.end() && device.find(0x1005) == nullptr) {
    findings.add(rules::pdo_sync, value_in_force(*pdo->parameter(2)).span,
                 fmt::format("{} depends on SYNC, but object 1005h is missing", title_of(*pdo)),
                 "describe 1005h, or use transmission type 254 or 255");
  }
}

}  // namespace

void check_pdo_parameters(const Device& device, Findings& findings) {
  const std::vector<Pdo> pdos = pdos_of(device);
  for (const Pdo& pdo : pdos) {
    check_pair(device, pdo, findings);
    if (pdo.mapping != nullptr) {
      check_mapping(device, pdo, findings);
    }
    if (pdo.communication != nullptr) {
      check_communication(pdo, findings);
    }
  }
  check_sync(device, pdos, findings);
}

}  // namespace lexican::codict::check
