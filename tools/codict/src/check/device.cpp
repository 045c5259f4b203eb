// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "check/check.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

void check_pdos(const Field<std::uint16_t>& number, std::uint16_t first, const Device& device, Findings& findings) {
  const auto described = std::count_if(device.objects.begin(), device.objects.end(), [first](const Object& object) {
    return object.index >= first && object.index < first + 0x200;
  });
  const bool may_be_implicit = device.features.compact_pdo.value != 0 && number.value > described;
  if (number.is_given && number.value != described && !may_be_implicit) {
    findings.add(rules::pdo_count, number.span,
                 fmt::format("{} is {}, but the number of described PDOs is {}",
                             first == 0x1400 ? "NrOfRXPDO" : "NrOfTXPDO", number.value, described),
                 "correct the number, or describe the PDOs");
  }
}

void check_identity(const Field<std::uint32_t>& number, std::uint8_t sub_index, const Device& device,
                    Findings& findings) {
  const Entry* const entry = device.find(0x1018, sub_index);
  if (number.is_empty() || entry == nullptr || !entry->default_value.is_integer()) {
    return;
  }
  if (entry->default_value.integer != Integer(number.value)) {
    findings.add(rules::identity, number.span,
                 fmt::format("{:X}h differs from {} in {}", number.value, text_of(entry->default_value),
                             subject_of(device, 0x1018, sub_index)),
                 "use one number in both places");
  }
}

}  // namespace

void check_device(const Device& device, Findings& findings) {
  check_pdos(device.features.rx_pdos, 0x1400, device, findings);
  check_pdos(device.features.tx_pdos, 0x1800, device, findings);
  check_identity(device.identity.vendor_number, 1, device, findings);
  check_identity(device.identity.product_number, 2, device, findings);
  check_identity(device.identity.revision_number, 3, device, findings);
}

}  // namespace lexican::codict::check
