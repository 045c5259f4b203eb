// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "check/check.hpp"
#include "model/subject.hpp"
#include "text/number.hpp"

namespace lexican::codict::check {

namespace {

void check_pdos(const Field<std::uint16_t>& number, std::uint16_t first, const Device& device, Findings& findings) {
  const auto described = std::count_if(device.objects.begin(), device.objects.end(), [first](const Object& object) {
    return object.index >= first && object.index < first + 0x200;
  });
  const bool may_be_implicit = device.features.compact_pdo.value != 0 && number.value > described;
  if (!number.is_empty() && number.value != described && !may_be_implicit) {
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

// Checks values that could be read; the reader has reported the others. FFh is the node-ID of an unconfigured node.
// [305]
void check_commissioning(const Commissioning& commissioning, Findings& findings) {
  constexpr std::array<std::uint32_t, 10> rates = {0, 10, 20, 50, 100, 125, 250, 500, 800, 1000};  // 0: automatic
  constexpr std::uint8_t unconfigured = 0xFF;
  const Field<std::uint8_t>& node_id = commissioning.node_id;
  const bool is_valid = (node_id.value >= 1 && node_id.value <= 127) || node_id.value == unconfigured;
  const ParsedInteger number = parse_integer(node_id.text);
  if (!is_valid && number.is_number() && number.value == Integer(node_id.value)) {
    findings.add(rules::node_id, node_id.span, fmt::format("node-ID {} is not in the range 1 to 127", node_id.value),
                 "correct it, or write 255 for a node without node-ID");
  }
  const Field<std::uint32_t>& rate = commissioning.bit_rate;
  if (std::find(rates.begin(), rates.end(), rate.value) == rates.end()) {
    findings.add(rules::bit_rate, rate.span, fmt::format("CiA 301 does not define {} kbit/s", rate.value),
                 "write 10, 20, 50, 100, 125, 250, 500, 800 or 1000, or 0 for automatic detection");
  }
}

}  // namespace

void check_device(const Device& device, Findings& findings) {
  check_pdos(device.features.rx_pdos, 0x1400, device, findings);
  check_pdos(device.features.tx_pdos, 0x1800, device, findings);
  check_identity(device.identity.vendor_number, 1, device, findings);
  check_identity(device.identity.product_number, 2, device, findings);
  check_identity(device.identity.revision_number, 3, device, findings);
  check_commissioning(device.commissioning, findings);
}

}  // namespace lexican::codict::check
