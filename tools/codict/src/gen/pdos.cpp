// SPDX-License-Identifier: Apache-2.0
// Checks of the PDO mappings in a description.
#include <fmt/format.h>

#include "gen/parts.hpp"
#include "gen/rules.hpp"

namespace lexican::codict::gen {

namespace {

constexpr unsigned most_bits = 64;
constexpr std::uint64_t multiplexed = 0xFE;  // value of sub-index 0 for a multiplex PDO, like FFh [301:7.5.2.36]

constexpr std::uint32_t off = 0x80000000;  // bit 31 of a COB-ID: the PDO is disabled
constexpr std::uint32_t identifier_bits = 0x1FFFFFFF;
constexpr std::uint16_t to_mapping = 0x200;  // distance from a communication parameter to its mapping parameter

constexpr std::uint64_t event_driven = 254;  // first transmission type; 255 is the other [301:7.5.2.35]

constexpr bool is_receive(std::uint16_t index) { return (index & 0x1800U) == 0x1000; }

// Returns "TPDO 3" for 1802h and 1A02h.
std::string title_of(std::uint16_t index) {
  return fmt::format("{} {}", is_receive(index) ? "RPDO" : "TPDO", (index & 0x1FFU) + 1);
}

// Returns true for a dummy object (0001h…0007h sub 0), whose bits an RPDO ignores. [301:7.4.1]
bool is_skipped(const Item& mapping, std::uint16_t index, std::uint8_t sub_index, unsigned bits) {
  return is_receive(mapping.index) && sub_index == 0 && index >= 1 && index <= 7 && data_type(index).bits == bits;
}

// Returns the length of an entry in bits, 0 if it is unknown.
unsigned bits_of(const Item& item) {
  const bool is_bit = item.form->code == type_code::boolean;
  return is_bit ? 1U : 8U * (item.form->bytes != 0 ? item.form->bytes : item.capacity);
}

// Decoded value of a mapping entry.
struct Link {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  unsigned bits = 0;

  explicit Link(const Item& mapping) {
    const std::uint64_t link = mapping.value.integer.magnitude;
    index = static_cast<std::uint16_t>(link >> 16);
    sub_index = static_cast<std::uint8_t>(link >> 8);
    bits = static_cast<unsigned>(link & 0xFFU);
  }
};

std::string name_of_object(const Item& object) { return fmt::format("{} ({})", place_name(object), object.name); }

// Returns the reason why the stack rejects a mapping entry, empty if it accepts the entry.
std::string fault_of(const Plan& plan, const Item& mapping) {
  const Link link(mapping);
  if (is_skipped(mapping, link.index, link.sub_index, link.bits)) {
    return {};
  }
  const std::string maps = fmt::format("{} maps ", place_name(mapping));
  if (link.index == 0) {
    return maps + "no object";
  }
  const Item* const object = plan.find(link.index, link.sub_index);
  if (object == nullptr) {
    return maps + fmt::format("{:04X}h sub {:X}, which has no entry", link.index, link.sub_index);
  }
  const bool receives = is_receive(mapping.index);
  if (receives ? !is_writable(object->access) : !is_readable(object->access)) {
    return maps + fmt::format("{}, which cannot be {} ({})", name_of_object(*object), receives ? "written" : "read",
                              codict::name_of(object->access));
  }
  const unsigned bits = bits_of(*object);
  const bool is_byte = link.bits == 8 && bits == 1;
  if (bits != 0 && link.bits != bits && !is_byte) {
    return maps + fmt::format("{} bits of {}, which has {}", link.bits, name_of_object(*object), bits);
  }
  return {};
}

// Reports mappings that work but may be mistakes.
void check_object(const Plan& plan, const Item& mapping, Span span, Findings& findings) {
  const Link link(mapping);
  const Item* const object = plan.find(link.index, link.sub_index);
  if (object == nullptr) {
    return;
  }
  if (object->pdo == PdoMapping::no) {
    findings.add(rules::pdo_mappable, span, fmt::format("mapped object {} has PDOMapping=0", name_of_object(*object)),
                 "set PDOMapping=1");
  }
  const bool goes_out = object->access == Access::rwr || object->pdo == PdoMapping::tpdo;
  const bool comes_in = object->access == Access::rww || object->pdo == PdoMapping::rpdo;
  if (is_receive(mapping.index) ? goes_out : comes_in) {
    const bool receives = is_receive(mapping.index);
    findings.add(rules::pdo_direction, span,
                 fmt::format("{} maps {}, which is for {}s", receives ? "RPDO" : "TPDO", name_of_object(*object),
                             receives ? "TPDO" : "RPDO"),
                 "correct the access type, or map another object");
  }
}

bool is_multiplexed(const Item& number) { return number.value.integer.magnitude >= multiplexed; }

void check_pdo(Plan& plan, const Item& number, Findings& findings) {
  if (is_multiplexed(number)) {
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
    const Span span = mapping->value.is_given ? mapping->value.span : mapping->span;
    const std::string fault = fault_of(plan, *mapping);
    if (fault.empty()) {
      check_object(plan, *mapping, span, findings);
    } else {
      findings.add(rules::pdo_object, span, fmt::format("{}: {}", title_of(number.index), fault),
                   "correct the mapping, or the access of the object");
    }
    sum.bits.push_back(static_cast<unsigned>(mapping->value.integer.magnitude & 0xFFU));
    bits += sum.bits.back();
  }
  if (bits > most_bits) {
    findings.add(rules::pdo_bits, number.span,
                 fmt::format("mapped objects have {} bits, more than {}", bits, most_bits),
                 "map fewer or shorter objects");
  }
  plan.pdos.push_back(std::move(sum));
}

// Returns the reason why the stack does not create a PDO with this mapping parameter, empty if it creates the PDO.
std::string fault_of_mapping(const Plan& plan, std::uint16_t index) {
  const Item* const number = plan.find(index, 0);
  if (number == nullptr) {
    return fmt::format("{:04X}h (its mapping) is missing", index);
  }
  if (is_multiplexed(*number)) {
    return {};
  }
  if (number->value.integer.magnitude == 0) {
    return fmt::format("{} is 0: it maps no object", place_name(*number));
  }
  for (unsigned sub = 1; sub <= number->value.integer.magnitude; ++sub) {
    const Item* const mapping = plan.find(index, static_cast<std::uint8_t>(sub));
    if (mapping == nullptr) {
      return fmt::format("{:04X}h sub {:X} is missing", index, sub);
    }
    std::string fault = fault_of(plan, *mapping);
    if (!fault.empty()) {
      return fault;
    }
  }
  return {};
}

// Disables the PDOs that the stack does not create, so that a master can see it in their COB-IDs.
void switch_off(Plan& plan, Findings& findings) {
  for (Item& item : plan.items) {
    Value& value = item.value;
    const bool is_on = item.type == "CO_TPDO_ID" && (value.integer.magnitude & off) == 0;
    if (!is_on) {
      continue;
    }
    const bool has_identifier = value.adds_node_id || (value.integer.magnitude & identifier_bits) != 0;
    const std::string fault = has_identifier
                                  ? fault_of_mapping(plan, static_cast<std::uint16_t>(item.index + to_mapping))
                                  : place_name(item) + " has no CAN-ID";
    if (fault.empty()) {
      continue;
    }
    findings.add(rules::pdo_off, value.is_given ? value.span : item.span,
                 fmt::format("{} is switched off (bit 31 of {}): {}", title_of(item.index), place_name(item), fault),
                 "correct the mapping, or set bit 31 of the COB-ID");
    value.integer.magnitude |= off;
    item.limits.edit().holds_default = false;
  }
}

bool triggers_tpdo(const Plan& plan, const Item& mapping) {
  const Link link(mapping);
  const Item* const object = plan.find(link.index, link.sub_index);
  return object != nullptr && (object->flags & flag_trigger) != 0;
}

bool maps_trigger(const Plan& plan, const Item& number) {
  for (unsigned sub = 1; sub <= number.value.integer.magnitude; ++sub) {
    const Item* const mapping = plan.find(number.index, static_cast<std::uint8_t>(sub));
    if (mapping != nullptr && triggers_tpdo(plan, *mapping)) {
      return true;
    }
  }
  return false;
}

// Reports TPDOs that neither a new value nor a timer transmits.
void check_triggers(const Plan& plan, Findings& findings) {
  for (const Item& item : plan.items) {
    const bool is_on =
        item.type == "CO_TPDO_ID" && !is_receive(item.index) && (item.value.integer.magnitude & off) == 0;
    const Item* const type = is_on ? plan.find(item.index, 2) : nullptr;
    const Item* const number = is_on ? plan.find(static_cast<std::uint16_t>(item.index + to_mapping), 0) : nullptr;
    if (type == nullptr || number == nullptr || type->value.integer.magnitude < event_driven ||
        is_multiplexed(*number)) {
      continue;
    }
    const Item* const timer = plan.find(item.index, 5);
    const bool has_timer = timer != nullptr && timer->value.integer.magnitude != 0;
    if (!has_timer && !maps_trigger(plan, *number)) {
      findings.add(
          rules::pdo_trigger, type->value.is_given ? type->value.span : type->span,
          fmt::format("{} is event-driven without event timer, and maps no object with flag A", title_of(item.index)),
          "set CO_flagsPDO (;TPDODetectCos=1) of an object, or call COTPdoTrigPdo()");
    }
  }
}

// Returns true if a mapping entry is a constant of the table and below the number of mapped objects, so that
// CO_OD_CHECK() checks it.
bool is_constant_mapping(const Plan& plan, const Item& item) {
  const Item* const number = plan.find(item.index, 0);
  const bool is_beyond =
      number != nullptr && (number->flags & flag_direct) != 0 &&
      (number->value.integer.magnitude >= multiplexed || item.sub_index > number->value.integer.magnitude);
  return (item.type == "CO_TPDO_MAP" || item.type == "CO_TSRDO_MAP") && (item.flags & flag_direct) != 0 && !is_beyond;
}

// Makes objects mappable (flag P) that a constant mapping contains. Such a PDO works, but CO_OD_CHECK() rejects a
// constant mapping of an object without flag P.
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
  switch_off(plan, findings);
  check_triggers(plan, findings);
  make_mappable(plan);
}

}  // namespace lexican::codict::gen
