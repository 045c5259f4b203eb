// SPDX-License-Identifier: Apache-2.0
// Signatures of SRDOs. [EN 50325-5]
#include "model/srdo.hpp"

#include <fmt/format.h>

#include "gen/parts.hpp"
#include "gen/rules.hpp"

namespace lexican::codict::gen {

namespace {

std::optional<std::uint64_t> number_in(const Plan& plan, std::uint16_t index, std::uint8_t sub_index) {
  const Item* const item = plan.find(index, sub_index);
  if (item == nullptr) {
    return 0;
  }
  return item->value.adds_node_id ? std::nullopt : std::optional(item->value.integer.bits());
}

}  // namespace

// Signatures that are given are not changed: they show that the parameters were reviewed.
void plan_srdos(Plan& plan, Findings& findings) {
  const NumberOf number_of = [&plan](std::uint16_t index, std::uint8_t sub_index) {
    return number_in(plan, index, sub_index);
  };
  for (Item& item : plan.items) {
    if (item.index != srdo_index::signatures || item.sub_index == 0 || item.sub_index > srdo_limit) {
      continue;
    }
    const std::optional<std::uint16_t> signature = srdo_signature(item.sub_index, number_of);
    if (!signature || item.value.integer != Integer(0)) {
      continue;
    }
    findings.add(rules::srdo_signature, item.value.is_given ? item.value.span : item.span,
                 fmt::format("signature of SRDO {} is filled in: {:04X}h", item.sub_index, *signature),
                 fmt::format("review the parameters, and write DefaultValue=0x{:04X}", *signature));
    item.value.kind = Value::Kind::integer;
    item.value.integer = *signature;
    item.value.text = fmt::format("0x{:04X}", *signature);
    item.limits.edit().holds_default = false;
  }
}

}  // namespace lexican::codict::gen
