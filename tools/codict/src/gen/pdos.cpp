// SPDX-License-Identifier: Apache-2.0
// What the PDOs of the description map.
#include <fmt/format.h>

#include "gen/parts.hpp"
#include "gen/rules.hpp"

namespace lexican::codict::gen {

namespace {

constexpr unsigned most_bits = 64;
constexpr std::uint32_t flag_pdo = 0x04;
constexpr std::uint32_t flag_direct = 0x80;
constexpr std::uint64_t multiplexed = 0xFE;  // and FFh: no number of objects [301:7.5.2.36]

constexpr bool is_receive(std::uint16_t index) { return index < 0x1800; }

// 0001h…0007h, sub 0: bits that an RPDO skips. [301:7.4.1]
bool is_skipped(std::uint16_t index, std::uint8_t sub_index, unsigned bits) {
  return sub_index == 0 && index >= 1 && index <= 7 && data_type(index).bits == bits;
}

unsigned bits_of(const Item& item) {
  const bool is_bit = item.form->code == type_code::boolean;
  return is_bit ? 1U : 8U * (item.form->bytes != 0 ? item.form->bytes : item.capacity);
}

void check_object(const Plan& plan, const Item& mapping, Findings& findings) {
  const std::uint64_t link = mapping.value.integer.magnitude;
  const auto index = static_cast<std::uint16_t>(link >> 16);
  const auto sub_index = static_cast<std::uint8_t>(link >> 8);
  const auto bits = static_cast<unsigned>(link & 0xFFU);
  const bool receives = is_receive(mapping.index);
  const Span span = mapping.value.is_given ? mapping.value.span : mapping.span;
  if (is_skipped(index, sub_index, bits)) {
    return;
  }
  const Item* const object = plan.find(index, sub_index);
  if (object == nullptr) {
    findings.add(rules::pdo_object, span, "it maps an object that has no entry");
    return;
  }
  if (receives ? !is_writable(object->access) : !is_readable(object->access)) {
    findings.add(rules::pdo_object, span, "it maps an object that may not be mapped");
    return;
  }
  if (object->pdo == PdoMapping::no) {
    findings.add(rules::pdo_mappable, span, "PDOMapping of the object is 0; the PDO maps it nevertheless");
  }
  if (bits != bits_of(*object) && !(bits == 8 && bits_of(*object) == 1)) {
    findings.add(rules::pdo_object, span, "the length is not that of the object");
  }
  const bool goes_out = object->access == Access::rwr || object->pdo == PdoMapping::tpdo;
  const bool comes_in = object->access == Access::rww || object->pdo == PdoMapping::rpdo;
  if (receives ? goes_out : comes_in) {
    findings.add(rules::pdo_direction, span, "the object is meant for PDOs of the other direction");
  }
}

void check_pdo(Plan& plan, const Item& number, Findings& findings) {
  if (number.value.integer.magnitude >= multiplexed) {
    return;
  }
  PdoSum sum;
  sum.index = number.index;
  unsigned bits = 0;
  for (unsigned sub = 1; sub <= number.value.integer.magnitude; ++sub) {
    const Item* const mapping = plan.find(number.index, static_cast<std::uint8_t>(sub));
    if (mapping == nullptr || !mapping->value.is_integer()) {
      continue;
    }
    check_object(plan, *mapping, findings);
    sum.bits.push_back(static_cast<unsigned>(mapping->value.integer.magnitude & 0xFFU));
    bits += sum.bits.back();
  }
  if (bits > most_bits) {
    findings.add(rules::pdo_bits, number.span, fmt::format("the mapped objects have {} bits", bits));
  }
  plan.pdos.push_back(std::move(sum));
}

// Whether a mapping is a constant of the table and can be in use: CO_OD_CHECK() knows it.
bool is_constant_mapping(const Plan& plan, const Item& item) {
  const Item* const number = plan.find(item.index, 0);
  const bool is_beyond =
      number != nullptr && (number->flags & flag_direct) != 0 &&
      (number->value.integer.magnitude >= multiplexed || item.sub_index > number->value.integer.magnitude);
  return item.type == "CO_TPDO_MAP" && (item.flags & flag_direct) != 0 && !is_beyond;
}

// The mapping of the description is its author's decision: the PDO works. CO_OD_CHECK() refuses a constant mapping of
// an object without flag P, so the object gets it.
void make_mappable(Plan& plan) {
  for (const Item& mapping : plan.items) {
    const std::uint64_t link = mapping.value.integer.magnitude;
    const Item* const object = plan.find(static_cast<std::uint16_t>(link >> 16), static_cast<std::uint8_t>(link >> 8));
    if (object != nullptr && object->pdo == PdoMapping::no && is_constant_mapping(plan, mapping)) {
      Item& changed = plan.items[static_cast<std::size_t>(object - plan.items.data())];
      changed.pdo = PdoMapping::optional;
      changed.flags |= flag_pdo;
    }
  }
}

}  // namespace

void plan_pdos(Plan& plan, Findings& findings) {
  for (const Item& item : plan.items) {
    if (item.type == "CO_TPDO_NUM") {
      check_pdo(plan, item, findings);
    }
  }
  make_mappable(plan);
}

}  // namespace lexican::codict::gen
