// SPDX-License-Identifier: Apache-2.0
// Multiplex PDOs, whose frames contain the multiplexer of the object. [301: 7.2.2.6, 7.5.2.36]
#include <fmt/format.h>

#include <algorithm>

#include "check/network.hpp"
#include "model/pdo.hpp"

namespace lexican::codict::check {

namespace {

constexpr std::uint64_t source_mode = 0xFE;  // sub-index 0 of the mapping: source address mode

bool has_object(const Device& device, std::uint16_t first, std::uint16_t last) {
  return std::any_of(device.objects.begin(), device.objects.end(),
                     [first, last](const Object& object) { return object.index >= first && object.index <= last; });
}

// Returns true if the device has an object scanner list (TPDO) or object dispatching list (RPDO).
bool has_list(const Device& device, bool is_transmit) {
  return is_transmit ? has_object(device, 0x1FA0, 0x1FCF) : has_object(device, 0x1FD0, 0x1FFF);
}

// A multiplexed PDO is event-driven: transmission type 254 or 255.
void check_type(const Pdo& pdo, Findings& findings) {
  const Entry* const type = pdo.parameter(2);
  if (type != nullptr && value_in_force(*type).is_integer() &&
      value_in_force(*type).integer.bits() < transmission_type::event_manufacturer) {
    findings.add(rules::multiplexed_type, value_in_force(*type).span,
                 fmt::format("multiplexed PDO with transmission type {}", value_in_force(*type).integer.bits()),
                 "write 254 or 255");
  }
}

}  // namespace

void check_multiplexed(const Device& device, Findings& findings) {
  for (const Pdo& pdo : pdos_of(device)) {
    if (!pdo.is_multiplexed) {
      continue;
    }
    const Value& mode = value_in_force(*pdo.mapping->find(0));
    if (!device.features.group_messaging.is_empty() && !device.features.group_messaging.value) {
      findings.add(rules::multiplexed, mode.span, "multiplexed PDO, but GroupMessaging is 0",
                   "set GroupMessaging=1, or correct sub-index 0");
    }
    if (mode.integer.bits() == source_mode && !has_list(device, pdo.is_transmit)) {
      findings.add(
          rules::multiplexed_list, mode.span,
          pdo.is_transmit ? "source address mode without scanner list" : "source address mode without dispatching list",
          pdo.is_transmit ? "describe 1FA0h to 1FCFh" : "describe 1FD0h to 1FFFh");
    }
    check_type(pdo, findings);
  }
}

}  // namespace lexican::codict::check
